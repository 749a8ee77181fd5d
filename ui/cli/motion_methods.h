// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "lift/baselines/gplvm_motion.h"
#include "lift/eval/evaluate_motion.h"
#include "lift/temporal/motion_database.h"
#include "lift/temporal/path_search.h"
#include "lift/temporal/segment_search.h"

namespace poselift::cli {

// The methods that `evaluate motion` compares, over one database. Making it trains
// the GPLVM. The database must outlive this, and this the methods.
class MotionMethods {
 public:
  static constexpr const char* kGplvmOfTheAction = "GPLVM of the action";

  MotionMethods(const MotionDatabase& database, uint64_t seed);

  // All but the next, in the order of the tables.
  std::vector<NamedMotionMethod> All() const;
  // The GPLVM of trials of one action alone; of the whole database where that has
  // no trial of the action.
  NamedMotionMethod GplvmOf(const std::string& action);

 private:
  NamedMotionMethod Gplvm(std::string name, const Style& style) const;

  const MotionDatabase& database_;
  StyleOptions style_options_;
  FeatureVector row_weights_;
  SegmentSearch search_;
  PathSearch paths_;
  Style style_;
  std::map<std::string, Style> style_of_;  // actions
};

// Those of the paper's figure 3.
const std::vector<std::string>& MethodsOfThePaper();

}  // namespace poselift::cli
