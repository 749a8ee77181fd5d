// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "lift/temporal/motion_database.h"
#include "lift/temporal/segment_graph.h"

namespace poselift {

// The K segments of a database that are nearest to the last m frames of a body,
// the training data of the local regression of C. Mousas, P. Newbury,
// C.-N. Anagnostopoulos, Data-Driven Motion Reconstruction Using Local Regression
// Models (section 4.1):
//
//   |w o (segment - query)|^2 = sum over m frames and 46 rows of w^2 differences^2
//
// with w the row weights (RowWeights, or the paper's ones).
struct SegmentSearchOptions {
  enum class Method {
    kBruteForce,  // all segments: exact, and ready at once
    kHnsw,        // HnswIndex: fast for single queries
    kGraph,       // SegmentGraph: fast for queries of one body, frame after frame
  };
  Method method = Method::kBruteForce;
  int num_frames = 2;    // m
  int num_nearest = 50;  // K
  // When not 0: of the segments of one trial that end within so many frames of
  // each other only the nearest, so that the K are not one second of one trial.
  int exclusion_frames = 0;
  // The last three are of no concern to brute force. More is nearer to it, and
  // slower; `width`: how many segments a search follows at a time, at least K.
  int width = 200;
  int max_links = 16;
  int build_width = 100;

  std::string Validate() const;  // empty, or which option is wrong and why
};

struct SegmentMatch {
  int end_frame = 0;  // of the segment, a column of the database; end_frame + 1 follows
  float squared_distance = 0.0f;
};

// What the queries of one body carry along, and storage: one a sequence and thread.
struct SearchCursor {
  GraphWalk walk;
  Eigen::Matrix<float, kNumFeatures, Eigen::Dynamic> scaled_query;
  // Segments whose distance the last search took; with kHnsw it is not known, 0.
  int num_visited = 0;
};

class SegmentSearch {
 public:
  // Copies what it needs of the database. Throws InputError for wrong options.
  SegmentSearch(const MotionDatabase& database, const FeatureVector& row_weights,
                const SegmentSearchOptions& options);
  ~SegmentSearch();

  // query: the last m frames, unscaled, 46 x m, oldest first. *matches: the K
  // nearest (all when there are fewer), nearest first; at equal distance the
  // earlier one. A fresh cursor begins a sequence. Throws std::invalid_argument
  // when the query has not m columns.
  void FindNearest(const Eigen::Ref<const FeatureMatrix>& query, SearchCursor* cursor,
                   std::vector<SegmentMatch>* matches) const;

  int NumSegments() const;
  const SegmentSearchOptions& options() const;
  const FeatureVector& row_weights() const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace poselift
