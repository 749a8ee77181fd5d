// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Smooth made-up motions of few dimensions, as real ones are. Brute force is
// compared with a naive loop, the other methods with brute force, on motions of
// the same kind that are not in the database.
#include "lift/temporal/segment_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "src/input_error.h"
#include "tests/support/planted_pose.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::RandomMatrix;
using testing::TestRng;

using Matches = std::vector<SegmentMatch>;
using Method = SegmentSearchOptions::Method;
constexpr Method kMethods[] = {Method::kBruteForce, Method::kHnsw, Method::kGraph};

// A mixture of five slow waves.
FeatureMatrix SmoothFeatures(const Eigen::MatrixXd& mixture, int num_frames, std::mt19937_64* rng) {
  const Eigen::MatrixXd speed_and_phase = RandomMatrix(mixture.cols(), 2, rng);
  Eigen::MatrixXd waves(mixture.cols(), num_frames);
  for (int t = 0; t < num_frames; ++t)
    waves.col(t) = (0.05 * t * speed_and_phase.col(0) + 3.0 * speed_and_phase.col(1)).array().sin();
  return mixture * waves;
}

struct World {
  explicit World(int num_trials) : rng(TestRng()), mixture(RandomMatrix(kNumFeatures, 5, &rng)) {
    for (int i = 0; i < num_trials; ++i)
      database.Append("trial", SmoothFeatures(mixture, 40 + 10 * i, &rng));
    weights = 0.5 + RandomMatrix(kNumFeatures, 1, &rng).array().abs();
  }

  std::mt19937_64 rng;
  Eigen::MatrixXd mixture;
  MotionDatabase database;
  FeatureVector weights;
};

// All segments, sorted, by the definition.
Matches NaiveMatches(const World& world, const FeatureMatrix& query) {
  const auto m = static_cast<int>(query.cols());
  Matches matches;
  for (const Trial& trial : world.database.trials)
    for (int t = trial.first_frame + m - 1; t < trial.first_frame + trial.num_frames - 1; ++t) {
      double sum = 0.0;
      for (int i = 0; i < m; ++i)
        for (int row = 0; row < kNumFeatures; ++row) {
          const double d = world.database.features(row, t - m + 1 + i) - query(row, i);
          sum += world.weights[row] * world.weights[row] * d * d;
        }
      matches.push_back({t, static_cast<float>(sum)});
    }
  std::stable_sort(matches.begin(), matches.end(), [](const auto& a, const auto& b) {
    return a.squared_distance < b.squared_distance;
  });
  return matches;
}

Matches Ask(const SegmentSearch& search, const FeatureMatrix& query, SearchCursor* cursor) {
  Matches matches;
  search.FindNearest(query, cursor, &matches);
  return matches;
}

double Recall(const Matches& found, const Matches& truth) {
  const auto near = std::count_if(found.begin(), found.end(), [&](const SegmentMatch& match) {
    return match.squared_distance <= truth.back().squared_distance;
  });
  return static_cast<double>(near) / static_cast<double>(truth.size());
}

void ExpectSorted(const Matches& matches) {
  EXPECT_TRUE(std::is_sorted(matches.begin(), matches.end(), [](const auto& a, const auto& b) {
    return a.squared_distance < b.squared_distance;
  }));
}

TEST(SegmentSearch, ByBruteForceFindsWhatANaiveLoopFinds) {
  World world(6);
  for (const int m : {1, 2, 3, 50}) {
    const SegmentSearch search(world.database, world.weights,
                               {.method = Method::kBruteForce, .num_frames = m, .num_nearest = 20});
    SearchCursor cursor;
    for (int i = 0; i < 10; ++i) {
      const FeatureMatrix query = SmoothFeatures(world.mixture, m, &world.rng);
      const Matches truth = NaiveMatches(world, query);
      const Matches found = Ask(search, query, &cursor);
      ASSERT_EQ(search.NumSegments(), static_cast<int>(truth.size()));
      EXPECT_EQ(cursor.num_visited, search.NumSegments());
      ASSERT_EQ(found.size(), 20u);
      for (size_t k = 0; k < found.size(); ++k) {
        EXPECT_EQ(found[k].end_frame, truth[k].end_frame);
        EXPECT_NEAR(found[k].squared_distance, truth[k].squared_distance,
                    1e-4 * truth[k].squared_distance);
      }
    }
  }
}

TEST(SegmentSearch, OfASegmentOfTheDatabaseFindsItFirst) {
  World world(10);
  for (const Method method : kMethods) {
    const SegmentSearch search(world.database, world.weights, {.method = method, .num_frames = 3});
    for (const int end : SegmentEnds(world.database, 3)) {
      SearchCursor cursor;
      const Matches found =
          Ask(search, world.database.features.middleCols(end - 2, 3).cast<double>(), &cursor);
      ASSERT_EQ(found[0].end_frame, end);
      ASSERT_LT(found[0].squared_distance, 1e-8);
    }
  }
}

TEST(SegmentSearch, ByHnswAndGraphFindsMostOfWhatBruteForceFinds) {
  World world(60);
  for (const Method method : {Method::kHnsw, Method::kGraph}) {
    const SegmentSearch brute(world.database, world.weights, {.method = Method::kBruteForce});
    const SegmentSearch search(world.database, world.weights, {.method = method});
    double recall = 0.0, visited = 0.0;
    SearchCursor brute_cursor;
    for (int sequence = 0; sequence < 10; ++sequence) {
      const FeatureMatrix motion = SmoothFeatures(world.mixture, 51, &world.rng);
      SearchCursor cursor;
      for (int t = 0; t < 50; ++t) {
        const Matches truth = Ask(brute, motion.middleCols<2>(t), &brute_cursor);
        const Matches found = Ask(search, motion.middleCols<2>(t), &cursor);
        ASSERT_EQ(found.size(), 50u);
        ExpectSorted(found);
        recall += Recall(found, truth) / 500.0;
        visited += cursor.num_visited / 500.0;
      }
    }
    EXPECT_GT(recall, 0.95);
    EXPECT_LT(visited, 0.2 * search.NumSegments());
    if (method == Method::kGraph) {
      EXPECT_GT(visited, 50.0);
    }
  }
}

TEST(SegmentSearch, ByGraphFindsItsWayAfterAJump) {
  World world(60);
  const SegmentSearch brute(world.database, world.weights, {.method = Method::kBruteForce});
  const SegmentSearch search(world.database, world.weights, {.method = Method::kGraph});
  SearchCursor cursor, brute_cursor;
  double recall = 0.0;
  for (int i = 0; i < 200; ++i) {
    const FeatureMatrix query = SmoothFeatures(world.mixture, 2, &world.rng);
    recall += Recall(Ask(search, query, &cursor), Ask(brute, query, &brute_cursor)) / 200.0;
  }
  EXPECT_GT(recall, 0.9);
}

// Frames between two segments of one trial; of two trials, very many.
int Apart(const MotionDatabase& database, const SegmentMatch& a, const SegmentMatch& b) {
  for (const Trial& trial : database.trials) {
    const int end = trial.first_frame + trial.num_frames;
    if ((a.end_frame < end) != (b.end_frame < end)) return database.NumFrames();
  }
  return std::abs(a.end_frame - b.end_frame);
}

TEST(SegmentSearch, TakesOneSegmentAWindow) {
  World world(30);
  constexpr int kWindow = 8;
  for (const Method method : kMethods) {
    const SegmentSearch search(world.database, world.weights,
                               {.method = method, .num_nearest = 10, .exclusion_frames = kWindow});
    SearchCursor cursor;
    for (int i = 0; i < 20; ++i) {
      const FeatureMatrix query = SmoothFeatures(world.mixture, 2, &world.rng);
      Matches wanted;
      for (const SegmentMatch& match : NaiveMatches(world, query)) {
        const bool excluded = std::any_of(wanted.begin(), wanted.end(), [&](const auto& other) {
          return Apart(world.database, match, other) <= kWindow;
        });
        if (!excluded && wanted.size() < 10) wanted.push_back(match);
      }
      const Matches found = Ask(search, query, &cursor);
      ASSERT_EQ(found.size(), 10u);
      ExpectSorted(found);
      for (size_t k = 0; k < 10 && method == Method::kBruteForce; ++k)
        EXPECT_EQ(found[k].end_frame, wanted[k].end_frame);
      for (size_t a = 0; a < 10; ++a)
        for (size_t b = 0; b < a; ++b)
          EXPECT_GT(Apart(world.database, found[a], found[b]), kWindow);
    }
  }
}

TEST(SegmentSearch, OfASmallDatabaseFindsAll) {
  World world(1);
  for (const Method method : kMethods) {
    const SegmentSearch search(world.database, world.weights, {.method = method});
    SearchCursor cursor;
    const FeatureMatrix query = SmoothFeatures(world.mixture, 2, &world.rng);
    const Matches found = Ask(search, query, &cursor);
    const Matches truth = NaiveMatches(world, query);
    ASSERT_EQ(found.size(), 38u);
    for (size_t k = 0; k < found.size(); ++k) EXPECT_EQ(found[k].end_frame, truth[k].end_frame);
  }
}

TEST(SegmentSearch, OfAnEmptyDatabaseFindsNothing) {
  MotionDatabase too_short;
  too_short.Append("two frames", FeatureMatrix::Zero(kNumFeatures, 2));
  for (const MotionDatabase& database : {MotionDatabase(), too_short})
    for (const Method method : kMethods) {
      const SegmentSearch search(database, FeatureVector::Ones(), {.method = method});
      SearchCursor cursor;
      EXPECT_TRUE(Ask(search, FeatureMatrix::Zero(kNumFeatures, 2), &cursor).empty());
      EXPECT_EQ(search.NumSegments(), 0);
    }
}

TEST(SegmentSearch, GivesTheSameAnswersEveryTime) {
  World world(20);
  const FeatureMatrix motion = SmoothFeatures(world.mixture, 30, &world.rng);
  for (const Method method : kMethods) {
    std::vector<Matches> runs[2];
    for (auto& run : runs) {
      const SegmentSearch search(world.database, world.weights, {.method = method});
      SearchCursor cursor;
      for (int t = 0; t + 2 <= 30; ++t)
        run.push_back(Ask(search, motion.middleCols<2>(t), &cursor));
    }
    for (size_t i = 0; i < runs[0].size(); ++i)
      for (size_t k = 0; k < runs[0][i].size(); ++k) {
        ASSERT_EQ(runs[0][i][k].end_frame, runs[1][i][k].end_frame);
        ASSERT_EQ(runs[0][i][k].squared_distance, runs[1][i][k].squared_distance);
      }
  }
}

TEST(SegmentSearch, RefusesWrongOptionsAndQueries) {
  World world(1);
  for (const SegmentSearchOptions& options :
       {SegmentSearchOptions{.num_frames = 0}, SegmentSearchOptions{.num_nearest = 0},
        SegmentSearchOptions{.exclusion_frames = -1}, SegmentSearchOptions{.width = 0},
        SegmentSearchOptions{.max_links = 1}, SegmentSearchOptions{.build_width = 0}}) {
    EXPECT_NE(options.Validate(), "");
    EXPECT_THROW(SegmentSearch(world.database, world.weights, options), InputError);
  }
  const SegmentSearch search(world.database, world.weights, {});
  SearchCursor cursor;
  EXPECT_THROW(Ask(search, FeatureMatrix::Zero(kNumFeatures, 3), &cursor), std::invalid_argument);
}

}  // namespace
}  // namespace poselift
