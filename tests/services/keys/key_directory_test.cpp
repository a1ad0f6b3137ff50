// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/keys/key_directory.hpp"

#include <sys/stat.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "deploy/kinds/kinds.hpp"
#include "services/files/atomic_file.hpp"
#include "services/keys/documents.hpp"
#include "services/keys/key_files.hpp"
#include "tests/temporary_folder.hpp"

namespace quoin {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

const char* const chain = R"(version: 1
namespace: robot
domain: 7
security: {keys: keys}
services:
  - {name: front, kind: simulated}
  - {name: walls, kind: segmentation, input: front, method: iepf}
  - {name: lines, kind: line_fitting, input: walls, method: utls, strength: 2}
  - {name: lines, kind: line_fitting, input: walls, method: pca, strength: 1}
)";

mode_t mode_of(const std::filesystem::path& file) {
  struct stat status {};
  EXPECT_EQ(::stat(file.c_str(), &status), 0) << file;
  return status.st_mode & 07777U;
}

std::string thrown_by(const std::function<void()>& function) {
  try {
    function();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "nothing thrown";
}

class KeyDirectory : public ::testing::Test {
 protected:
  KeyDirectory() {
    make_key_directory(keys_, 10, false);
    for (const std::string& identity : identities_of(deployment_)) {
      add_identity(keys_, load_authority(keys_), identity, valid_for_days(5), false);
      permit(identity, valid_for_days(5));
    }
  }

  void permit(const std::string& identity, const Validity& validity) {
    write_permissions(keys_, load_authority(keys_), identity, validity,
                      {rule_of(deployment_, identity)});
  }
  [[nodiscard]] OpensslCertificate certificate_of(const std::string& identity) const {
    return parse_certificate(read_file(identity_files(keys_, identity).certificate));
  }
  [[nodiscard]] std::string objection_to(const std::string& identity) const {
    const TrustFiles trust = trust_files(keys_, true);
    return objection(certificate_of(identity).get(),
                     parse_certificate(read_file(trust.authority)).get(),
                     parse_revocation_list(read_file(trust.revoked)).get());
  }

  tests::TemporaryFolder folder_;
  std::filesystem::path keys_ = folder_.path() / "keys";
  Deployment deployment_ = deploy::parse_deployment(chain, folder_.path() / "robot.yaml");
};

TEST_F(KeyDirectory, IdentitiesAreSignedByTheAuthorityAndNamed) {
  EXPECT_THAT(identities_in(keys_), ElementsAre("front", "lines@1", "lines@2", "quoin-observer",
                                                "quoin-operator", "walls"));
  for (const std::string& identity : identities_in(keys_)) {
    EXPECT_EQ(objection_to(identity), "");
    EXPECT_EQ(common_name(certificate_of(identity).get()), identity);
    EXPECT_THAT(key_problems(deployment_, identity), IsEmpty());
  }
  const auto left = certificate_end(keys_, "walls") - std::chrono::system_clock::now();
  EXPECT_LE(left, std::chrono::hours(5 * 24));
  EXPECT_GT(left, std::chrono::hours(5 * 24) - std::chrono::minutes(10));
}

TEST_F(KeyDirectory, SecretsAreForTheOwnerAlone) {
  EXPECT_EQ(mode_of(authority_key(keys_)), 0600U);
  EXPECT_EQ(mode_of(identity_files(keys_, "walls").private_key), 0600U);
  for (const char* name : {"", "ca", "trust", "identities", "identities/walls"}) {
    EXPECT_EQ(mode_of(keys_ / name), 0700U) << name;
  }
  EXPECT_THAT(read_file(authority_key(keys_)), HasSubstr("BEGIN PRIVATE KEY"));
}

TEST_F(KeyDirectory, AKeyThatOthersCanReadIsRefused) {
  const std::filesystem::path key = identity_files(keys_, "front").private_key;
  for (const auto mode :
       {std::filesystem::perms::others_read, std::filesystem::perms::group_read}) {
    std::filesystem::permissions(key, mode, std::filesystem::perm_options::add);
    const auto problems = key_problems(deployment_, "front");
    ASSERT_EQ(problems.size(), 1U);
    EXPECT_THAT(problems[0], HasSubstr("chmod 600 " + key.string()));
    std::filesystem::permissions(key, mode, std::filesystem::perm_options::remove);
  }
}

TEST_F(KeyDirectory, NothingIsOverwrittenUnasked) {
  const std::string secret = read_file(authority_key(keys_));
  EXPECT_THAT(thrown_by([&] { make_key_directory(keys_, 10, false); }), HasSubstr("--force"));
  EXPECT_EQ(read_file(authority_key(keys_)), secret);
  const KeyPair authority = load_authority(keys_);
  const std::string key = read_file(identity_files(keys_, "walls").private_key);
  const auto add = [&](bool replace) {
    add_identity(keys_, authority, "walls", valid_for_days(5), replace);
  };
  EXPECT_THAT(thrown_by([&] { add(false); }), HasSubstr("--force"));
  EXPECT_EQ(read_file(identity_files(keys_, "walls").private_key), key);
  add(true);
  EXPECT_NE(read_file(identity_files(keys_, "walls").private_key), key);
  EXPECT_EQ(objection_to("walls"), "");
  for (const auto& entry : std::filesystem::recursive_directory_iterator(keys_)) {
    EXPECT_THAT(entry.path().extension().string(), ::testing::AnyOf("", ".pem", ".smime"));
  }
}

TEST_F(KeyDirectory, NamesThatLeaveTheFolderAreRefused) {
  const KeyPair authority = load_authority(keys_);
  for (const std::string name : {"", "..", "../x", "a/b", "a b", "<x>"}) {
    EXPECT_ANY_THROW(add_identity(keys_, authority, name, valid_for_days(1), false)) << name;
  }
}

TEST_F(KeyDirectory, ExpiredRevokedAndForeignCertificatesAreRefusedWithTheWayOut) {
  const auto now = std::chrono::system_clock::now();
  add_identity(keys_, load_authority(keys_), "front",
               {now - std::chrono::hours(48), now - std::chrono::hours(1)}, true);
  EXPECT_EQ(objection_to("front"), "certificate has expired");
  EXPECT_THAT(key_problems(deployment_, "front"),
              ElementsAre(folder_.path().string() + "/robot.yaml: security: " + keys_.string() +
                          "/identities/front/certificate.pem: certificate has expired; quoin keys "
                          "add " +
                          keys_.string() + " front --force renews it"));

  revoke_identity(keys_, load_authority(keys_), "walls");
  revoke_identity(keys_, load_authority(keys_), "walls");  // once more does no harm
  EXPECT_EQ(objection_to("walls"), "certificate revoked");
  EXPECT_EQ(objection_to("lines@1"), "");
  add_identity(keys_, load_authority(keys_), "walls", valid_for_days(5), true);
  EXPECT_EQ(objection_to("walls"), "");

  make_key_directory(keys_, 10, true);
  EXPECT_EQ(objection_to("walls"), "unable to get local issuer certificate");
}

TEST_F(KeyDirectory, WhatIsMissingOrOutdatedIsToldWithTheWayOut) {
  std::filesystem::remove(identity_files(keys_, "walls").private_key);
  std::filesystem::remove(identity_files(keys_, "front").permissions);
  try {
    require_keys(deployment_, {"front", "walls"});
    FAIL();
  } catch (const DeploymentError& error) {
    ASSERT_EQ(error.messages().size(), 2U) << error.what();
    EXPECT_THAT(error.messages()[0], HasSubstr("identities/front/permissions.smime: No such file"));
    EXPECT_THAT(error.messages()[0], HasSubstr("quoin keys permissions"));
    EXPECT_THAT(error.messages()[1], HasSubstr("identities/walls/key.pem: No such file"));
    EXPECT_THAT(error.messages()[1], HasSubstr("quoin keys add"));
  }
  const auto now = std::chrono::system_clock::now();
  permit("front", {now - std::chrono::hours(48), now - std::chrono::hours(1)});
  EXPECT_THAT(key_problems(deployment_, "front"), ElementsAre(HasSubstr("have expired")));
  permit("front", valid_for_days(1));
  deployment_.domain = 8;
  EXPECT_THAT(key_problems(deployment_, "front"), ElementsAre(HasSubstr("other topics")));
  deployment_.domain = 7;
  const KeyPair authority = load_authority(keys_);
  ASSERT_EQ(write_atomically(trust_files(keys_, true).governance,
                             sign_document("<dds/>", authority), 0644),
            0);
  EXPECT_THAT(key_problems(deployment_, "front"), ElementsAre(HasSubstr("another version")));
  write_governance(keys_, authority);
  EXPECT_THAT(key_problems(deployment_, "front"), IsEmpty());
  deployment_.security.reset();
  EXPECT_THAT(key_problems(deployment_, "front"), IsEmpty());
}

TEST_F(KeyDirectory, DocumentsThatWereChangedAreNotAccepted) {
  const KeyPair authority = load_authority(keys_);
  const std::string text = governance_text(true);
  std::string document = sign_document(text, authority);
  EXPECT_EQ(verify_document(document, authority.certificate.get()), text);
  const KeyPair other = make_authority("other", valid_for_days(1));
  EXPECT_ANY_THROW((void)verify_document(document, other.certificate.get()));
  document.replace(document.find("<id_range>"), 10, "<ID_RANGE>");
  EXPECT_ANY_THROW((void)verify_document(document, authority.certificate.get()));
  EXPECT_THAT(governance_text(true), HasSubstr("<data_protection_kind>ENCRYPT<"));
  EXPECT_THAT(governance_text(false), Not(HasSubstr("ENCRYPT")));
}

TEST_F(KeyDirectory, EveryIdentityMayDoItsPartAndNothingElse) {
  EXPECT_EQ(rule_of(deployment_, "front"),
            (TopicRule{7,
                       {"robot/front/scan", "robot/status", "robot/control/reply"},
                       {"robot/control/request"}}));
  EXPECT_EQ(rule_of(deployment_, "lines@1"),
            (TopicRule{7,
                       {"robot/lines/lines", "robot/status", "robot/control/reply"},
                       {"robot/walls/segments", "robot/control/request"}}));
  const std::vector<std::string> results{"robot/*/lines", "robot/*/scan", "robot/*/segments",
                                         "robot/status"};
  EXPECT_EQ(rule_of(deployment_, "quoin-observer"), (TopicRule{7, {}, results}));
  const TopicRule rule = rule_of(deployment_, "quoin-operator");
  EXPECT_THAT(rule.writes, ElementsAre("robot/control/request", "robot/control/reply"));
  EXPECT_EQ(rule.reads.back(), "robot/control/reply");
  EXPECT_THROW((void)rule_of(deployment_, "nobody"), std::out_of_range);

  const std::string text = verify_document(read_file(identity_files(keys_, "walls").permissions),
                                           load_authority(keys_).certificate.get());
  EXPECT_THAT(text, HasSubstr("<subject_name>CN=walls</subject_name>"));
  EXPECT_THAT(text, HasSubstr("<domains><id>7</id></domains>"));
  EXPECT_THAT(text, HasSubstr("<topic>robot/walls/segments</topic>"));
  EXPECT_THAT(text, HasSubstr("<default>DENY</default>"));
  EXPECT_THAT(text, Not(HasSubstr("*")));
}

}  // namespace
}  // namespace quoin
