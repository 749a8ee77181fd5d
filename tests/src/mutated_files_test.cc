// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: every reader. Made up: small files, cut off everywhere and damaged at random, seeded.
// Checked: each is refused by InputError that names the file, or read as its header promises.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "src/input_error.h"
#include "tests/support/mutation.h"
#include "tests/support/readers.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::DamagedCopies;
using ::testing::HasSubstr;
using testing::Reader;
using testing::ScratchDir;

class MutatedFiles : public ::testing::TestWithParam<size_t> {
 protected:
  const Reader& reader() const { return testing::Readers()[GetParam()]; }
};

TEST_P(MutatedFiles, AreRefusedOrReadWhole) {
  const std::string whole = reader().whole(ScratchDir());
  ASSERT_EQ(FlawOf(reader(), whole, ScratchDir()), "");
  auto rng = testing::TestRng();
  int num_refused = 0;
  for (const std::string& damaged : DamagedCopies(whole, 300, &rng)) {
    try {
      ASSERT_EQ(FlawOf(reader(), damaged, ScratchDir()), "");
    } catch (const InputError& error) {
      ASSERT_THAT(error.what(), HasSubstr(reader().file));
      ASSERT_LT(std::string(error.what()).size(), 1000u);
      ++num_refused;
    }
  }
  EXPECT_GT(num_refused, 3);
}

INSTANTIATE_TEST_SUITE_P(OfEveryFormat, MutatedFiles,
                         ::testing::Range<size_t>(0, testing::Readers().size()),
                         [](const auto& param_info) {
                           return testing::Readers()[param_info.param].name;
                         });

}  // namespace
}  // namespace poselift
