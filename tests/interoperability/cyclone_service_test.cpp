// SPDX-License-Identifier: Apache-2.0
// Services between panvo and ROS 2 nodes on rmw_cyclonedds, which puts a header in front of requests and replies.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <string>

#include "beside_cyclone.hpp"
#include "process.hpp"
#include "std_srvs/srv/SetBool.h"

namespace panvo::test {
namespace {

using runtime::from_bytes;
using runtime::to_bytes;
using std_srvs::srv::SetBool_Request;
using std_srvs::srv::SetBool_Response;
using testing::HasSubstr;

constexpr std::chrono::seconds kLimit(60);
const runtime::ServiceDescription kService{"/light", "std_srvs/srv/SetBool"};

class CycloneService : public BesideCyclone {
 protected:
  std::unique_ptr<runtime::BridgeService> serve(runtime::ServiceGuard guard = {}) {
    return bridge_->serve(kService,
                          runtime::service_handler<SetBool_Request, SetBool_Response>([](const auto& request) {
                            SetBool_Response response;
                            response.success(request.data());
                            response.message(request.data() ? "on" : "off");
                            return response;
                          }),
                          std::move(guard));
  }
};

TEST_F(CycloneService, IsAnsweredByUsWithTheNumbersOfItsRequests) {
  const auto service = serve();
  Process calling({CYCLONE_PEER, std::to_string(domain_), "call", kService.name, "3"});
  EXPECT_EQ(calling.wait(kLimit), 0) << calling.output();
  EXPECT_THAT(calling.output(), HasSubstr("answer 1 1 on\nanswer 2 0 off\nanswer 3 1 on\n"));
  EXPECT_EQ(service->counters().malformed, 0U);
}

TEST_F(CycloneService, IsAnsweredOnceTheReaderOfThatClientIsKnown) {
  const auto service = serve();
  Process calling({CYCLONE_PEER, std::to_string(domain_), "call_before_reading", kService.name});
  EXPECT_EQ(calling.wait(kLimit), 0) << calling.output();
  EXPECT_THAT(calling.output(), HasSubstr("answer 7\n"));
}

TEST_F(CycloneService, IsKnownToCallFromThisHost) {
  std::atomic<int> from_here = 0, from_elsewhere = 0;
  const auto service = serve([&](const auto&, const runtime::Caller& caller) {
    ++(caller.is_on_this_host ? from_here : from_elsewhere);
    return std::nullopt;
  });
  Process calling({CYCLONE_PEER, std::to_string(domain_), "call", kService.name, "3"});
  EXPECT_EQ(calling.wait(kLimit), 0) << calling.output();
  EXPECT_EQ(from_here, 3);
  EXPECT_EQ(from_elsewhere, 0);
}

TEST_F(CycloneService, AnswersUs) {
  const Process serving({CYCLONE_PEER, std::to_string(domain_), "serve", kService.name});
  const auto client = bridge_->open_client(kService);
  ASSERT_TRUE(client->wait_for_service(kLimit)) << serving.output();
  const auto ask = [&](bool data, std::chrono::milliseconds limit) {
    SetBool_Request request;
    request.data(data);
    return client->call(to_bytes(request), limit);
  };
  // Cyclone accepts requests from the first heartbeat on: the first may be lost.
  ASSERT_TRUE(eventually([&] { return ask(true, std::chrono::milliseconds(200)).has_value(); }, kLimit));
  for (const bool data : {true, false}) {
    const auto answer = ask(data, kLimit);
    ASSERT_TRUE(answer) << serving.output();
    EXPECT_EQ(from_bytes<SetBool_Response>(*answer).success(), data);
    EXPECT_EQ(from_bytes<SetBool_Response>(*answer).message(), "cyclone");
  }
}

}  // namespace
}  // namespace panvo::test
