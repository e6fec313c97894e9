// SPDX-License-Identifier: Apache-2.0
#include "panvo/localizer/dispute.hpp"

#include <algorithm>

namespace panvo::localizer {

void Dispute::add(std::int64_t reference_ns, std::int64_t stamp_ns, double difference, const Blame& blame) {
  if (!is_on()) {
    blame_ = blame;
  } else if (reference_ns != reference_ns_) {
    before_ += last_;
  }
  reference_ns_ = reference_ns;
  last_ = difference;
  stamp_ns_ = stamp_ns;
}

double Dispute::growth(double doubt) const noexcept {
  return doubt * std::max(0.0, total() * total() - before_ * before_);
}

}  // namespace panvo::localizer
