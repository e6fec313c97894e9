// SPDX-License-Identifier: Apache-2.0
#include "tls_context.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "panvo/test/temporary_folder.hpp"
#include "tls_client.hpp"

namespace panvo::web_view {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::StartsWith;

std::string why_refused(const TlsFiles& files) {
  try {
    const TlsContext context(files);
    return "accepted";
  } catch (const CertificateError& error) {
    return error.what();
  }
}

TEST(TlsContext, SaysWhatIsWrongWithItsFiles) {
  const panvo::test::TemporaryFolder folder;
  const auto good = test::make_certificate(folder.path(), "good"),
             other = test::make_certificate(folder.path(), "other");
  const auto old = test::make_certificate(folder.path(), "old", -60);
  const auto rubbish = folder.write("rubbish.pem", "rubbish");
  ::chmod(rubbish.c_str(), 0600);
  const auto none = folder / "none.pem";
  EXPECT_EQ(why_refused({good.certificate, good.key}), "accepted");
  EXPECT_EQ(
      why_refused({none, good.key}),
      "tls_certificate " + none.string() + ": cannot be read: No such file or directory; name a file in PEM format");
  EXPECT_THAT(why_refused({good.certificate, none}),
              StartsWith("tls_key " + none.string() + ": cannot be read: No such"));
  EXPECT_EQ(why_refused({good.certificate, {}}), "tls_certificate " + good.certificate.string() + ": set tls_key, too");
  EXPECT_EQ(why_refused({{}, good.key}), "tls_key " + good.key.string() + ": set tls_certificate, too");
  EXPECT_EQ(why_refused({good.certificate, other.key}),
            "tls_key " + other.key.string() + ": is not the key of tls_certificate " + good.certificate.string() +
                "; name files that were made together");
  EXPECT_THAT(why_refused({old.certificate, old.key}),
              MatchesRegex("tls_certificate .*: expired on 20..-..-.. ..:.. UTC; renew it, or correct the clock.*"));
  EXPECT_THAT(why_refused({rubbish, good.key}), HasSubstr("is not a usable certificate in PEM format"));
  EXPECT_THAT(why_refused({good.certificate, rubbish}), HasSubstr("is not a usable private key in PEM format"));
  ::chmod(good.key.c_str(), 0640);
  EXPECT_THAT(why_refused({good.certificate, good.key}),
              AllOf(HasSubstr("readable by other users"), HasSubstr("chmod 600 " + good.key.string())));
}

}  // namespace
}  // namespace panvo::web_view
