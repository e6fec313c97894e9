// SPDX-License-Identifier: Apache-2.0
#include "remote_only_filter.hpp"

#include <fastdds/dds/topic/IContentFilter.hpp>

namespace panvo::runtime::dds {

namespace fdds = eprosima::fastdds::dds;
using eprosima::fastrtps::rtps::GUID_t;
using eprosima::fastrtps::types::ReturnCode_t;

namespace {

/// A filter without state, which serves all topics, and its factory.
class RemoteOnlyFilter final : fdds::IContentFilter, fdds::IContentFilterFactory {
 public:
  fdds::IContentFilterFactory& factory() { return *this; }

 private:
  bool evaluate(const SerializedPayload&, const FilterSampleInfo& info, const GUID_t& reader) const override {
    return info.sample_identity.writer_guid().guidPrefix != reader.guidPrefix;
  }

  ReturnCode_t create_content_filter(const char*, const char*, const fdds::TopicDataType*, const char*,
                                     const ParameterSeq&, fdds::IContentFilter*& filter) override {
    filter = this;
    return ReturnCode_t::RETCODE_OK;
  }

  ReturnCode_t delete_content_filter(const char*, fdds::IContentFilter*) override { return ReturnCode_t::RETCODE_OK; }
};

}  // namespace

fdds::IContentFilterFactory& remote_only_filters() {
  static RemoteOnlyFilter filter;
  return filter.factory();
}

eprosima::fastrtps::rtps::WriteParams written_by(const GUID_t& writer) {
  eprosima::fastrtps::rtps::WriteParams params;
  params.sample_identity().writer_guid(writer);
  return params;
}

}  // namespace panvo::runtime::dds
