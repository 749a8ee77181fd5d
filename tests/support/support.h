// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <random>
#include <string>
#include <utility>

namespace poselift::testing {

// A generator seeded by the running test's own name: the order of tests never
// matters.
std::mt19937_64 TestRng();

// A fresh empty folder of the running test; removed at the next run.
std::filesystem::path ScratchDir();

// A file of the source tree, e.g. SourcePath("tests/golden/arm.bvh").
std::filesystem::path SourcePath(const std::string& relative);

// The folder of real data (mocap/, photos/, ...) beside the project, or the one
// that POSELIFT_DATA names; nothing when it is absent.
std::optional<std::filesystem::path> DataDir();

// Writes text to a file of the scratch folder and returns its path.
std::string WriteScratch(const std::string& name, const std::string& text);

// False for NaN on either side.
::testing::AssertionResult MatrixNear(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                                      double tolerance);

}  // namespace poselift::testing

// Ends the test with a clear line when the real data is absent.
#define POSELIFT_DATA_OR_SKIP(variable)                                                 \
  auto variable##_or_none = ::poselift::testing::DataDir();                             \
  if (!variable##_or_none) GTEST_SKIP() << "real data absent: set POSELIFT_DATA to it"; \
  const std::filesystem::path variable = std::move(*variable##_or_none)
