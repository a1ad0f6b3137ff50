// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/viewer/server.hpp"

#include <arpa/inet.h>
#include <mutex>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <gmock/gmock.h>

#include "services/viewer/page.hpp"

namespace quoin::viewer {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// A connection to the server, byte by byte.
class Wire {
 public:
  explicit Wire(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ = ::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
  }
  ~Wire() { ::close(socket_); }
  Wire(const Wire&) = delete;
  Wire& operator=(const Wire&) = delete;

  void send(const std::string& bytes) const {
    ASSERT_TRUE(connected_);
    ASSERT_EQ(::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(bytes.size()));
  }
  /// What comes until `text` is in it, the connection ends, or nothing comes for 10 s.
  std::string receive_until(std::string_view text) {
    std::string all;
    char buffer[65536];
    pollfd wait_for{socket_, POLLIN, 0};
    while (all.find(text) == std::string::npos && ::poll(&wait_for, 1, 10000) == 1) {
      const ssize_t count = ::recv(socket_, buffer, sizeof buffer, 0);
      if (count <= 0) break;
      all.append(buffer, static_cast<std::size_t>(count));
    }
    return all;
  }
  /// Whether the other side ends the connection within 10 s.
  bool ends() {
    char buffer[65536];
    pollfd wait_for{socket_, POLLIN, 0};
    while (::poll(&wait_for, 1, 10000) == 1) {
      if (::recv(socket_, buffer, sizeof buffer, 0) <= 0) return true;
    }
    return false;
  }

 private:
  int socket_;
  bool connected_ = false;
};

class ServerTest : public testing::Test {
 protected:
  ServerTest() { channel = hub.add_channel({0, "front/scan", "cdr", "", "", ""}); }

  Server& start(const AccessRules& access = {}) {
    server = std::make_unique<Server>(ServerSettings{.port = 0, .access = access}, hub,
                                      [this](const std::string& text) {
                                        const std::lock_guard lock(mutex);
                                        log += text + "\n";
                                      });
    return *server;
  }
  std::string get(const std::string& target, const std::string& headers) {
    Wire wire(server->port());
    wire.send("GET " + target + " HTTP/1.1\r\nConnection: close\r\n" + headers + "\r\n");
    return wire.receive_until("~never~");
  }
  static std::string upgrade(const std::string& headers, const std::string& target = "/") {
    return "GET " + target +
           " HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
           "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n" +
           headers + "\r\n";
  }
  inline static const std::string protocol = "Sec-WebSocket-Protocol: foxglove.websocket.v1\r\n";

  std::mutex mutex;
  std::string log;
  Hub hub{"robot"};
  std::uint32_t channel = 0;
  std::unique_ptr<Server> server;
};

TEST_F(ServerTest, ServesThePageWithAPolicyThatLoadsNothingElse) {
  start();
  const std::string page = get("/", "Host: localhost\r\n");
  EXPECT_THAT(page, StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(page, HasSubstr("<title>Quoin</title>"));
  EXPECT_THAT(page, HasSubstr("Content-Security-Policy: default-src 'none'"));
  EXPECT_THAT(get("/style.css?x", "Host: localhost\r\n"), HasSubstr("Content-Type: text/css"));
}

TEST_F(ServerTest, PageIsSmallAndNamesNoOtherHost) {
  std::size_t bytes = 0;
  for (const PageFile& file : page_files()) {
    bytes += file.text.size();
    // The namespace of SVG is a name, not an address.
    for (std::size_t at = file.text.find("http"); at != std::string_view::npos;
         at = file.text.find("http", at + 1)) {
      const std::string_view rest = file.text.substr(at, 40);
      EXPECT_TRUE(rest.starts_with("http://www.w3.org/2000/svg") || !rest.starts_with("http://"))
          << rest;
      EXPECT_FALSE(rest.starts_with("https://")) << rest;
    }
  }
  EXPECT_LT(bytes, 300'000U);
}

TEST_F(ServerTest, ReadsNoFilesForAnybody) {
  start();
  for (const char* target :
       {"/../../etc/passwd", "//etc/passwd", "/%2e%2e/etc/passwd", "/index.html", "*"}) {
    EXPECT_THAT(get(target, "Host: localhost\r\n"), StartsWith("HTTP/1.1 404")) << target;
  }
}

TEST_F(ServerTest, RefusesStrangeHostsAndOrigins) {
  start();
  EXPECT_THAT(get("/", "Host: evil.example\r\n"), StartsWith("HTTP/1.1 403"));
  Wire wire(server->port());
  wire.send(upgrade(protocol + "Origin: https://evil.example\r\n"));
  EXPECT_THAT(wire.receive_until("origin"), StartsWith("HTTP/1.1 403"));
  const std::lock_guard lock(mutex);
  EXPECT_THAT(log, HasSubstr("origin 'https://evil.example'"));
}

TEST_F(ServerTest, RefusesAWrongToken) {
  start({.token = "0123456789abcdef"});
  Wire wrong(server->port());
  wrong.send(upgrade(protocol, "/?token=0123456789abcdee"));
  EXPECT_THAT(wrong.receive_until("token"), StartsWith("HTTP/1.1 401"));
  Wire right(server->port());
  right.send(upgrade(protocol, "/?token=0123456789abcdef"));
  EXPECT_THAT(right.receive_until("serverInfo"), StartsWith("HTTP/1.1 101"));
}

TEST_F(ServerTest, RefusesOtherMethodsBodiesAndEndlessHeads) {
  start();
  Wire post(server->port());
  post.send("POST / HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_THAT(post.receive_until("\r\n"), StartsWith("HTTP/1.1 405"));
  Wire body(server->port());
  body.send("GET / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 5\r\n\r\nhello");
  EXPECT_TRUE(body.ends());
  Wire endless(server->port());
  endless.send("GET / HTTP/1.1\r\nHost: localhost\r\nX: " + std::string(20000, 'x') + "\r\n\r\n");
  EXPECT_TRUE(endless.ends());
}

TEST_F(ServerTest, SpeaksOnlyItsOwnSubprotocols) {
  start();
  Wire none(server->port());
  none.send(upgrade(""));
  EXPECT_THAT(none.receive_until("\r\n"), StartsWith("HTTP/1.1 400"));
  Wire both(server->port());
  both.send(upgrade("Sec-WebSocket-Protocol: foxglove.websocket.v1, foxglove.sdk.v1\r\n"));
  EXPECT_THAT(both.receive_until("\r\n\r\n"), HasSubstr("Sec-WebSocket-Protocol: foxglove.sdk.v1"));
}

TEST_F(ServerTest, ClosesOnGarbageAndGoesOnServing) {
  start();
  Wire wire(server->port());
  wire.send(upgrade(protocol));
  wire.receive_until("serverInfo");
  wire.send(std::string("\x81\x83\0\0\0\0{{{", 9));                        // a text frame
  EXPECT_THAT(wire.receive_until("not the protocol"), HasSubstr("\x88"));  // a close frame
  Wire noise(server->port());
  noise.send(upgrade(protocol));
  noise.receive_until("serverInfo");
  noise.send(std::string(20, '\xff'));
  EXPECT_TRUE(noise.ends());
  EXPECT_THAT(get("/", "Host: localhost\r\n"), StartsWith("HTTP/1.1 200"));
}

TEST_F(ServerTest, AFrameTooLargeEndsTheConnection) {
  start();
  Wire wire(server->port());
  wire.send(upgrade(protocol));
  wire.receive_until("serverInfo");
  wire.send(std::string("\x81\xff\0\0\0\x7f\0\0\0\0\0\0\0\0", 14));  // announces 545 GB
  EXPECT_TRUE(wire.ends());
}

TEST_F(ServerTest, AClientThatStopsReadingLosesTheOldestAndHoldsUpNobody) {
  start();
  hub.limit(4, {.queued_bytes = 1'000'000});
  Wire stopped(server->port());
  stopped.send(upgrade(protocol));
  stopped.receive_until("advertise");
  // {"op":"subscribe","subscriptions":[{"id":1,"channelId":1}]} with a mask of zeros
  const std::string text = R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":1}]})";
  stopped.send(std::string("\x81") + static_cast<char>(0x80 | text.size()) + std::string(4, '\0') +
               text);
  for (int i = 0; i < 5000 && !hub.wanted(channel); ++i) ::usleep(1000);
  ASSERT_TRUE(hub.wanted(channel));
  // Far more than the queue and what the kernel takes.
  const auto owner = std::make_shared<const std::string>(100'000, 'x');
  for (int i = 0; i < 400; ++i) hub.publish(channel, {owner, std::as_bytes(std::span(*owner)), i});
  EXPECT_GT(hub.figures().dropped, 100U);
  EXPECT_THAT(get("/", "Host: localhost\r\n"), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(stopped.receive_until("too slow"), HasSubstr("front/scan"));
}

TEST_F(ServerTest, APortInUseIsNamed) {
  const std::uint16_t port = start().port();
  try {
    const Server second({.port = port}, hub, [](const std::string&) {});
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr(std::to_string(port)));
  }
}

}  // namespace
}  // namespace quoin::viewer
