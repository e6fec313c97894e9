// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/dds.h>

#include <string>

namespace panvo::test::cyclone {

/// A client of the std_srvs/srv/SetBool service `name`, like rmw_cyclonedds: sends `count` requests, alternately true
/// and false, and prints `answer NUMBER SUCCESS MESSAGE` for each response to one of them. Throws std::runtime_error.
void call_service(dds_domainid_t domain, const std::string& name, int count);

/// A second client in a process, whose reply reader is created some time after its request was sent: prints
/// `answer NUMBER` once the reply has come.
void call_before_reading(dds_domainid_t domain, const std::string& name);

/// A server of it: prints `serving`, and answers requests with their own value and the message "cyclone", until the
/// process is ended.
void serve(dds_domainid_t domain, const std::string& name);

}  // namespace panvo::test::cyclone
