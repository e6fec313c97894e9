// SPDX-License-Identifier: Apache-2.0
#include "remote_only_filter.hpp"

#include <fastdds/dds/topic/IContentFilter.hpp>

#include "fast_dds.hpp"

namespace panvo::runtime::dds {

namespace {

/// A filter without state, which serves all topics, and its factory.
class RemoteOnlyFilter final : fdds::IContentFilter, fdds::IContentFilterFactory {
 public:
  fdds::IContentFilterFactory& factory() { return *this; }

 private:
  bool evaluate(const SerializedPayload&, const FilterSampleInfo& info, const rtps::GUID_t& reader) const override {
    return info.sample_identity.writer_guid().guidPrefix != reader.guidPrefix;
  }

  ReturnCode create_content_filter(const char*, const char*, const fdds::TopicDataType*, const char*,
                                   const ParameterSeq&, fdds::IContentFilter*& filter) override {
    filter = this;
    return kOk;
  }

  ReturnCode delete_content_filter(const char*, fdds::IContentFilter*) override { return kOk; }
};

}  // namespace

fdds::IContentFilterFactory& remote_only_filters() {
  static RemoteOnlyFilter filter;
  return filter.factory();
}

rtps::WriteParams written_by(const rtps::GUID_t& writer) {
  rtps::WriteParams params;
  params.sample_identity().writer_guid(writer);
  return params;
}

}  // namespace panvo::runtime::dds
