// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real motion, when it is there: a database of some subjects, mirrored, searched
// by every trial of others, frame after frame. Each method reports its time a
// query and its recall, the share of the K that brute force finds. Brute force
// is asked, and recall is taken, at every tenth query.
#include "lift/temporal/segment_search.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <map>

#include "lift/dictionary_file.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using Matches = std::vector<SegmentMatch>;
using Method = SegmentSearchOptions::Method;

constexpr int kTruthStride = 10;

struct Motions {
  MotionDatabase trained, asked;
  FeatureVector weights;
};

const Motions* LoadMotions() {
  static const auto loaded = []() -> std::unique_ptr<Motions> {
    const auto data = testing::DataDir();
    if (!data) return nullptr;
    const Skeleton standard =
        ReadDictionary(std::filesystem::path(POSELIFT_SOURCE_DIR) / "data/default.pldict").skeleton;
    const std::filesystem::path folder = *data / "mocap/cmu";
    const auto of = [&](const std::vector<std::string>& subjects, bool mirrored) {
      return LoadMotionDatabase(FindMotions(folder, {subjects, {}}), standard,
                                {.mirrored = mirrored});
    };
    Motions motions{of({"01", "02", "03", "05", "14", "17", "29"}, true),
                    of({"07", "09", "16", "49"}, false),
                    {}};
    motions.weights = RowWeights(motions.trained);
    return std::make_unique<Motions>(std::move(motions));
  }();
  return loaded.get();
}

// Calls done(matches, num_visited, t) at every stride-th frame t of each trial; a
// trial is a sequence.
template <class Done>
void AskAll(const SegmentSearch& search, const Motions& motions, int num_frames, int stride,
            const Done& done) {
  Matches matches;
  FeatureMatrix query;
  for (const Trial& trial : motions.asked.trials) {
    SearchCursor cursor;
    for (int t = num_frames; t < trial.num_frames; t += stride) {
      const int first_frame = trial.first_frame + t - num_frames;
      query = motions.asked.features.middleCols(first_frame, num_frames).cast<double>();
      search.FindNearest(query, &cursor, &matches);
      done(matches, cursor.num_visited, t);
    }
  }
}

const std::vector<Matches>& Truth(const Motions& motions, int num_frames) {
  static std::map<int, std::vector<Matches>> truths;
  std::vector<Matches>& truth = truths[num_frames];
  if (truth.empty()) {
    const SegmentSearch brute(motions.trained, motions.weights,
                              {.method = Method::kBruteForce, .num_frames = num_frames});
    AskAll(brute, motions, num_frames, kTruthStride,
           [&](const Matches& matches, int, int) { truth.push_back(matches); });
  }
  return truth;
}

// Counted by distance, so that of segments at one distance any will do.
double Recall(const Matches& found, const Matches& truth) {
  const auto near = std::count_if(found.begin(), found.end(), [&](const SegmentMatch& match) {
    return match.squared_distance <= truth.back().squared_distance * (1.0f + 1e-6f);
  });
  return static_cast<double>(near) / static_cast<double>(truth.size());
}

void Search(benchmark::State& state, Method method) {
  const Motions* motions = LoadMotions();
  if (!motions) {
    state.SkipWithError("real data absent: set POSELIFT_DATA to it");
    return;
  }
  SegmentSearchOptions options;
  options.method = method;
  options.num_frames = static_cast<int>(state.range(0));
  options.width = static_cast<int>(state.range(1));
  const auto start = std::chrono::steady_clock::now();
  const SegmentSearch search(motions->trained, motions->weights, options);
  const std::chrono::duration<double> build = std::chrono::steady_clock::now() - start;

  const std::vector<Matches>& truth = Truth(*motions, options.num_frames);
  const int stride = method == Method::kBruteForce ? kTruthStride : 1;
  double recall = 0.0, visited = 0.0, num_queries = 0.0;
  for (auto _ : state) {
    recall = visited = num_queries = 0.0;
    size_t i = 0;
    AskAll(search, *motions, options.num_frames, stride,
           [&](const Matches& matches, int num_visited, int t) {
             if ((t - options.num_frames) % kTruthStride == 0)
               recall += Recall(matches, truth[i++]);
             visited += num_visited;
             ++num_queries;
           });
  }
  state.SetItemsProcessed(state.iterations() * static_cast<int64_t>(num_queries));
  state.counters["segments"] = search.NumSegments();
  state.counters["queries"] = num_queries;
  state.counters["build_s"] = build.count();
  state.counters["recall"] = recall / static_cast<double>(truth.size());
  state.counters["visited"] = visited / num_queries;
  state.counters["s_a_query"] = benchmark::Counter(
      num_queries, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void Arguments(benchmark::internal::Benchmark* bench) {
  bench->ArgNames({"m", "width"})->Unit(benchmark::kMillisecond);
  for (const int num_frames : {2, 3}) bench->Args({num_frames, SegmentSearchOptions().width});
}
BENCHMARK_CAPTURE(Search, brute, Method::kBruteForce)
    ->Name("segment_search/brute")
    ->Apply(Arguments)
    ->Iterations(1);
BENCHMARK_CAPTURE(Search, hnsw, Method::kHnsw)->Name("segment_search/hnsw")->Apply(Arguments);
BENCHMARK_CAPTURE(Search, graph, Method::kGraph)->Name("segment_search/graph")->Apply(Arguments);

}  // namespace
}  // namespace poselift
