// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>

#include "src/io/json_value.h"
#include "src/skeleton.h"

namespace poselift {

// What the JSON headers of learned models share (docs/FORMATS.md). Readers throw
// InputError for a value that is not there or not of its kind; what the values
// mean is the caller's to check (SkeletonFlaw).

nlohmann::ordered_json SkeletonToJson(const Skeleton& skeleton);
Skeleton ReadSkeleton(const JsonValue& value);

int ReadWhole(const JsonValue& value);
std::int64_t ReadLargeWhole(const JsonValue& value);  // up to 2^53

// A string: readers of JSON round numbers beyond 2^53.
nlohmann::ordered_json SeedToJson(unsigned long seed);
unsigned long ReadSeed(const JsonValue& value);

// An array of so many values; wanted: for the message.
const std::vector<JsonValue>& ReadItems(const JsonValue& value, size_t count, const char* wanted);

}  // namespace poselift
