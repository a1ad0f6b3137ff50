// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/viewer/access.hpp"

#include <gtest/gtest.h>

#include "services/viewer/settings.hpp"

namespace quoin::viewer {
namespace {

Caller caller(std::string_view host, std::optional<std::string_view> origin = std::nullopt,
              std::string_view target = "/", std::string_view authorization = "") {
  return {host, origin, target, authorization};
}

TEST(Access, AddressesAndLocalhostAreGoodHosts) {
  for (const char* host :
       {"127.0.0.1:8765", "localhost:8765", "LOCALHOST", "192.168.1.7:80", "[::1]:8765"}) {
    EXPECT_EQ(may_fetch({}, caller(host)), Refusal::none) << host;
  }
}

TEST(Access, NamesThatSomebodysDnsPointsHereAreNot) {
  for (const char* host :
       {"evil.example:8765", "", "127.0.0.1.evil.example", "localhost.evil.example", "1.2.3.x"}) {
    EXPECT_EQ(may_fetch({}, caller(host)), Refusal::host) << host;
  }
  EXPECT_EQ(may_fetch({.hosts = {"Robot.local"}}, caller("robot.local:8765")), Refusal::none);
}

TEST(Access, OwnPageAndWhatIsNoBrowserMayConnect) {
  EXPECT_EQ(may_connect({}, caller("127.0.0.1:8765")), Refusal::none);
  EXPECT_EQ(may_connect({}, caller("127.0.0.1:8765", "http://127.0.0.1:8765")), Refusal::none);
  EXPECT_EQ(may_connect({}, caller("robot:1", "http://robot:1")), Refusal::host);
}

TEST(Access, PagesOfOthersMayNotUnlessListed) {
  for (const char* origin : {"https://evil.example", "http://127.0.0.1:9999", "null", "file://",
                             "ftp://127.0.0.1:8765", "http://127.0.0.1:8765.evil.example"}) {
    EXPECT_EQ(may_connect({}, caller("127.0.0.1:8765", origin)), Refusal::origin) << origin;
  }
  const AccessRules rules{.origins = {"https://app.foxglove.dev"}};
  EXPECT_EQ(may_connect(rules, caller("127.0.0.1:8765", "https://app.foxglove.dev")),
            Refusal::none);
}

TEST(Access, TokenIsNeededForTheWebSocketNotForThePage) {
  const AccessRules rules{.token = "0123456789abcdef"};
  EXPECT_EQ(may_fetch(rules, caller("10.0.0.1")), Refusal::none);
  EXPECT_EQ(may_connect(rules, caller("10.0.0.1")), Refusal::token);
  EXPECT_EQ(may_connect(rules, caller("10.0.0.1", {}, "/?token=0123456789abcdee")), Refusal::token);
  EXPECT_EQ(may_connect(rules, caller("10.0.0.1", {}, "/?token=0123456789abcdef0")),
            Refusal::token);
  EXPECT_EQ(may_connect(rules, caller("10.0.0.1", {}, "/?xtoken=0123456789abcdef")),
            Refusal::token);
  EXPECT_EQ(may_connect(rules, caller("10.0.0.1", {}, "/?a=b&token=0123456789abcdef")),
            Refusal::none);
  EXPECT_EQ(may_connect(rules, caller("10.0.0.1", {}, "/", "Bearer 0123456789abcdef")),
            Refusal::none);
}

TEST(ViewerSettings, AnAddressThatOthersReachGetsAToken) {
  ViewerParameters parameters;
  EXPECT_EQ(server_settings(parameters, "").access.token, "");
  parameters.address = "0.0.0.0";
  const std::string token = server_settings(parameters, "").access.token;
  EXPECT_EQ(token.size(), 32U);
  EXPECT_NE(server_settings(parameters, "").access.token, token);
}

TEST(ViewerSettings, RefusesWeakTokensAndHalfACertificate) {
  ViewerParameters parameters;
  parameters.token = "short";
  EXPECT_THROW((void)server_settings(parameters, ""), ParameterError);
  parameters.token = "sixteen chars & more";
  EXPECT_THROW((void)server_settings(parameters, ""), ParameterError);
  parameters.token = "";
  parameters.key = "key.pem";
  EXPECT_THROW((void)server_settings(parameters, ""), ParameterError);
  parameters.certificate = "certificate.pem";
  EXPECT_EQ(server_settings(parameters, "/robot").key, "/robot/key.pem");
}

TEST(ViewerSettings, ListsHaveCommas) {
  ViewerParameters parameters;
  parameters.origins = " https://a.example ,, https://b.example";
  const auto origins = server_settings(parameters, "").access.origins;
  ASSERT_EQ(origins.size(), 2U);
  EXPECT_EQ(origins[0], "https://a.example");
  EXPECT_EQ(origins[1], "https://b.example");
}

}  // namespace
}  // namespace quoin::viewer
