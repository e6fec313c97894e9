// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <iostream>
#include <streambuf>
#include <string>

#include "panvo/runtime/printable.hpp"

namespace panvo::runtime::graph {

/// During its lifetime, makes std::cout print complete lines without terminal control characters, as most text comes
/// from other processes.
class PrintableOutput final : std::streambuf {
 public:
  PrintableOutput() : out_(std::cout.rdbuf(this)) {}
  ~PrintableOutput() override {
    sync();
    std::cout.rdbuf(out_);
  }
  PrintableOutput(const PrintableOutput&) = delete;
  PrintableOutput& operator=(const PrintableOutput&) = delete;

 private:
  int_type overflow(int_type letter) override {
    if (traits_type::eq_int_type(letter, traits_type::eof())) return traits_type::not_eof(letter);
    line_ += traits_type::to_char_type(letter);
    return letter != '\n' || write_line() ? letter : traits_type::eof();
  }
  int sync() override { return write_line() && out_->pubsync() == 0 ? 0 : -1; }

  bool write_line() {
    const std::string shown = printable(line_);
    line_.clear();
    return out_->sputn(shown.data(), static_cast<std::streamsize>(shown.size())) ==
           static_cast<std::streamsize>(shown.size());
  }

  std::streambuf* out_;
  std::string line_;
};

}  // namespace panvo::runtime::graph
