// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/viewer/server.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

// After <utility>, which Boost 1.74 forgets in C++20.
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/ssl.hpp>
#include <boost/beast/websocket.hpp>
#include <boost/beast/websocket/ssl.hpp>

#include "services/viewer/page.hpp"

namespace quoin::viewer {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using beast::error_code;
using std::chrono::seconds;

constexpr std::size_t largest_head = 8192;    // [byte] of a request
constexpr std::size_t largest_frame = 65536;  // [byte] of a client
constexpr std::size_t most_connections = 64;  // before and after they became clients
constexpr seconds request_timeout{10};
constexpr seconds idle_timeout{30};

/// What all connections share.
struct Shared {
  Hub& hub;
  AccessRules access;
  Server::Log log;
  std::size_t connections = 0;  // of the thread of the server
};

/// Counts a connection for as long as it lives.
class Counted {
 public:
  explicit Counted(Shared& shared) : shared_(shared) { ++shared_.connections; }
  ~Counted() { --shared_.connections; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;

 private:
  Shared& shared_;
};

const char* text_of(Refusal refusal) {
  switch (refusal) {
    case Refusal::host:
      return "unknown host name; allow it with 'hosts'\n";
    case Refusal::origin:
      return "pages of this origin may not connect; allow them with 'origins'\n";
    case Refusal::token:
      return "the token is missing or wrong: open the address that was printed at the start\n";
    case Refusal::none:
      break;
  }
  return "";
}

std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

Caller caller_of(const http::request<http::empty_body>& request) {
  Caller caller;
  caller.host = view(request[http::field::host]);
  const auto origin = request.find(http::field::origin);
  if (origin != request.end()) caller.origin = view(origin->value());
  caller.target = view(request.target());
  caller.authorization = view(request[http::field::authorization]);
  return caller;
}

/// The first of our subprotocols that the client asks for; "" when there is none.
std::string_view chosen_subprotocol(beast::string_view asked) {
  for (const std::string_view ours : subprotocols) {
    for (const auto each : http::token_list(asked)) {
      if (view(each) == ours) return ours;
    }
  }
  return {};
}

/// A client on a WebSocket. Lives as long as something is under way on its connection.
template <class Stream>
class ClientSession : public std::enable_shared_from_this<ClientSession<Stream>> {
 public:
  ClientSession(Stream stream, std::shared_ptr<Counted> counted, Shared& shared)
      : socket_(std::move(stream)), counted_(std::move(counted)), shared_(shared) {}
  ~ClientSession() {
    if (client_) shared_.hub.disconnect(*client_);
  }

  void start(const http::request<http::empty_body>& request, std::string_view subprotocol) {
    websocket::stream_base::timeout timeout{request_timeout, idle_timeout, true};
    socket_.set_option(timeout);
    socket_.set_option(websocket::stream_base::decorator(
        [name = std::string(subprotocol)](websocket::response_type& response) {
          response.set(http::field::sec_websocket_protocol, name);
        }));
    socket_.read_message_max(largest_frame);
    socket_.async_accept(request, [self = this->shared_from_this()](error_code error) {
      if (!error) self->greet();
    });
  }

 private:
  void greet() {
    client_ =
        shared_.hub.connect([weak = this->weak_from_this(), executor = socket_.get_executor()] {
          asio::post(executor, [weak] {
            if (const auto self = weak.lock()) self->send_next();
          });
        });
    if (!client_) {
      shared_.log("refused a client: there are too many already");
      return close({websocket::close_code::try_again_later, "too many clients"});
    }
    send_next();
    receive();
  }

  void receive() {
    socket_.async_read(buffer_, [self = this->shared_from_this()](error_code error, std::size_t) {
      if (!error) self->received();
    });
  }

  void received() {
    const auto data = buffer_.cdata();
    const std::string_view bytes(static_cast<const char*>(data.data()), data.size());
    try {
      if (socket_.got_text()) {
        shared_.hub.receive_text(*client_, bytes);
      } else {
        shared_.hub.receive_binary(*client_, bytes);
      }
    } catch (const ProtocolError& error) {
      shared_.log(std::string("a client sent what is no frame of the protocol: ") + error.what());
      return close({websocket::close_code::protocol_error, "not the protocol"});
    }
    buffer_.consume(buffer_.size());
    if (client_->flooded()) {
      return close({websocket::close_code::policy_error, "answers are not read"});
    }
    send_next();
    receive();
  }

  void send_next() {
    if (sending_ || closing_) return;
    sending_ = client_->next();
    if (!sending_) return;
    socket_.text(sending_->text);
    const std::array<asio::const_buffer, 2> buffers{
        asio::buffer(sending_->head),
        asio::buffer(sending_->payload.bytes.data(), sending_->payload.bytes.size())};
    socket_.async_write(buffers, [self = this->shared_from_this()](error_code error, std::size_t) {
      self->sending_.reset();
      if (!error) self->send_next();
    });
  }

  void close(const websocket::close_reason& reason) {
    closing_ = true;
    socket_.async_close(reason, [self = this->shared_from_this()](error_code) {});
  }

  websocket::stream<Stream> socket_;
  std::shared_ptr<Counted> counted_;
  Shared& shared_;
  beast::flat_buffer buffer_{largest_frame};
  std::shared_ptr<Client> client_;
  std::optional<Frame> sending_;
  bool closing_ = false;
};

/// A connection that has not become a WebSocket: answers with files of the page.
template <class Stream>
class PageSession : public std::enable_shared_from_this<PageSession<Stream>> {
 public:
  PageSession(Stream stream, Shared& shared)
      : stream_(std::move(stream)), shared_(shared), counted_(std::make_shared<Counted>(shared)) {}

  void start() {
    if constexpr (std::is_same_v<Stream, beast::tcp_stream>) {
      receive();
    } else {
      beast::get_lowest_layer(stream_).expires_after(request_timeout);
      stream_.async_handshake(asio::ssl::stream_base::server,
                              [self = this->shared_from_this()](error_code error) {
                                if (!error) self->receive();
                              });
    }
  }

 private:
  void receive() {
    parser_.emplace();
    parser_->header_limit(largest_head);
    parser_->body_limit(0);
    beast::get_lowest_layer(stream_).expires_after(request_timeout);
    http::async_read(stream_, buffer_, *parser_,
                     [self = this->shared_from_this()](error_code error, std::size_t) {
                       if (!error) self->received();
                     });
  }

  void received() {
    const auto& request = parser_->get();
    const Caller caller = caller_of(request);
    const bool upgrade = websocket::is_upgrade(request);
    const Refusal refusal =
        upgrade ? may_connect(shared_.access, caller) : may_fetch(shared_.access, caller);
    if (refusal != Refusal::none) {
      note_refusal(caller, refusal);
      const auto code =
          refusal == Refusal::token ? http::status::unauthorized : http::status::forbidden;
      return answer(code, "text/plain; charset=utf-8", text_of(refusal));
    }
    if (upgrade) {
      const std::string_view subprotocol =
          chosen_subprotocol(request[http::field::sec_websocket_protocol]);
      if (subprotocol.empty()) {
        return answer(http::status::bad_request, "text/plain; charset=utf-8",
                      "ask for the subprotocol foxglove.sdk.v1 or foxglove.websocket.v1\n");
      }
      beast::get_lowest_layer(stream_).expires_never();
      auto session = std::make_shared<ClientSession<Stream>>(std::move(stream_), counted_, shared_);
      return session->start(request, subprotocol);
    }
    if (request.method() != http::verb::get && request.method() != http::verb::head) {
      return answer(http::status::method_not_allowed, "text/plain; charset=utf-8", "GET only\n");
    }
    const std::string_view path = caller.target.substr(0, caller.target.find('?'));
    const auto files = page_files();
    const auto file = std::ranges::find(files, path, &PageFile::path);
    if (file == files.end()) {
      return answer(http::status::not_found, "text/plain; charset=utf-8",
                    "there is no such page\n");
    }
    answer(http::status::ok, file->type, file->text);
  }

  void note_refusal(const Caller& caller, Refusal refusal) {
    std::string who;
    if (refusal == Refusal::host) who = "host '" + std::string(caller.host.substr(0, 100)) + "'";
    if (refusal == Refusal::origin)
      who = "origin '" + std::string(caller.origin->substr(0, 100)) + "'";
    if (refusal == Refusal::token) who = "no or a wrong token";
    for (char& c : who) {
      if (static_cast<unsigned char>(c) < 32 || c == 127) c = '?';
    }
    shared_.log("refused a connection: " + who);
  }

  void answer(http::status code, std::string_view type, std::string_view text) {
    const auto& request = parser_->get();
    // The texts are constants of the program.
    http::response<http::span_body<const char>> response{
        code, request.version(),
        beast::span<const char>(text.data(),
                                request.method() == http::verb::head ? 0 : text.size())};
    response.set(http::field::content_type, beast::string_view(type.data(), type.size()));
    response.set(http::field::cache_control, "no-store");
    response.set("X-Content-Type-Options", "nosniff");
    response.set("Referrer-Policy", "no-referrer");
    response.set("Cross-Origin-Resource-Policy", "same-origin");
    response.set("Content-Security-Policy",
                 "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self' ws: "
                 "wss:; img-src 'self' data: blob:; frame-ancestors 'none'; base-uri 'none'; "
                 "form-action 'none'");
    response.keep_alive(request.keep_alive());
    response.content_length(text.size());
    response_.emplace(std::move(response));
    http::async_write(stream_, *response_,
                      [self = this->shared_from_this()](error_code error, std::size_t) {
                        self->answered(error);
                      });
  }

  void answered(error_code error) {
    const bool go_on = !error && response_->keep_alive();
    response_.reset();
    if (go_on) return receive();
    error_code ignored;
    beast::get_lowest_layer(stream_).socket().shutdown(tcp::socket::shutdown_send, ignored);
  }

  Stream stream_;
  Shared& shared_;
  std::shared_ptr<Counted> counted_;
  beast::flat_buffer buffer_{largest_head};
  std::optional<http::request_parser<http::empty_body>> parser_;
  std::optional<http::response<http::span_body<const char>>> response_;
};

}  // namespace

struct Server::Impl {
  Impl(const ServerSettings& given, Hub& hub, Log log)
      : settings(given), shared{hub, given.access, std::move(log)}, acceptor(context) {
    if (!settings.key.empty()) use_certificate();
    listen();
    accept();
    thread = std::thread([this] { context.run(); });
  }
  ~Impl() {
    context.stop();
    thread.join();
  }

  void use_certificate() {
    tls.emplace(asio::ssl::context::tls_server);
    error_code error;
    tls->set_options(asio::ssl::context::default_workarounds | asio::ssl::context::no_tlsv1 |
                         asio::ssl::context::no_tlsv1_1,
                     error);
    tls->use_certificate_chain_file(settings.certificate.string(), error);
    if (error) throw std::runtime_error(settings.certificate.string() + ": " + error.message());
    tls->use_private_key_file(settings.key.string(), asio::ssl::context::pem, error);
    if (error) throw std::runtime_error(settings.key.string() + ": " + error.message());
  }

  void listen() {
    error_code error;
    const std::string name = settings.address == "localhost" ? "127.0.0.1" : settings.address;
    const auto address = asio::ip::make_address(name, error);
    if (error) throw std::runtime_error("'" + settings.address + "' is not an IP address");
    const tcp::endpoint endpoint(address, settings.port);
    acceptor.open(endpoint.protocol());
    acceptor.set_option(asio::socket_base::reuse_address(true));
    acceptor.bind(endpoint, error);
    if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
    if (error) {
      throw std::runtime_error("port " + std::to_string(settings.port) + " of " + settings.address +
                               " cannot be used: " + error.message() + "; choose another port");
    }
  }

  void accept() {
    acceptor.async_accept([this](error_code error, tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (error) {  // no descriptors left, say: not again at once
        pause.expires_after(seconds(1));
        return pause.async_wait([this](error_code stopped) {
          if (!stopped) accept();
        });
      }
      if (shared.connections < most_connections) serve(std::move(socket));
      accept();
    });
  }

  void serve(tcp::socket socket) {
    error_code ignored;
    socket.set_option(tcp::no_delay(true), ignored);
    beast::tcp_stream stream(std::move(socket));
    if (tls) {
      using Tls = beast::ssl_stream<beast::tcp_stream>;
      std::make_shared<PageSession<Tls>>(Tls(std::move(stream), *tls), shared)->start();
    } else {
      std::make_shared<PageSession<beast::tcp_stream>>(std::move(stream), shared)->start();
    }
  }

  ServerSettings settings;
  Shared shared;
  std::optional<asio::ssl::context> tls;
  asio::io_context context{1};
  tcp::acceptor acceptor;
  asio::steady_timer pause{context};
  std::thread thread;
};

Server::Server(const ServerSettings& settings, Hub& hub, Log log)
    : impl_(std::make_unique<Impl>(settings, hub, std::move(log))) {}

Server::~Server() = default;

std::uint16_t Server::port() const { return impl_->acceptor.local_endpoint().port(); }

std::string Server::url() const {
  const ServerSettings& settings = impl_->settings;
  const bool everywhere = settings.address == "0.0.0.0" || settings.address == "::";
  std::string host = everywhere ? "localhost" : settings.address;
  if (host.find(':') != std::string::npos) host = "[" + host + "]";
  return (settings.key.empty() ? "http://" : "https://") + host + ":" + std::to_string(port()) +
         "/" + (settings.access.token.empty() ? "" : "?token=" + settings.access.token);
}

}  // namespace quoin::viewer
