// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Files of made-up dictionaries. What is read is what was written to the last
// bit; a damaged file is always refused, at every byte and every length; a file
// that lies under a right checksum is refused for each of its lies.
#include "lift/dictionary_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "src/input_error.h"
#include "tests/support/random_dictionary.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::RandomDictionary;
using testing::ScratchDir;
using testing::TestRng;
using testing::WriteScratch;

constexpr size_t kVersionAt = 8;
constexpr size_t kHeaderBytesAt = 12;
constexpr size_t kFileBytesAt = 20;
constexpr size_t kHeaderAt = 28;
constexpr size_t kChecksumBytes = 4;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Dictionary WithPriorAndRecord(int num_atoms) {
  auto rng = TestRng();
  Dictionary dictionary = RandomDictionary(num_atoms, &rng);
  dictionary.prior = LearnPosePrior(RandomDictionary(200, &rng).atoms);
  dictionary.skeleton.bones[2].dofs[0].lower = -kInfinity;
  dictionary.skeleton.bones[2].dofs[0].upper = kInfinity;
  dictionary.atoms(4, 0) = -0.0;
  dictionary.atoms.col(0).normalize();
  dictionary.record = {.sources = {"a.amc", "Z\xC3\xBCrich \"1\".bvh"},
                       .command = "poselift train --seed 18446744073709551615",
                       .commit = "0123abc",
                       .num_poses = 3'000'000'000,
                       .mirrored = true,
                       .sparsity = 12,
                       .num_subsets = 24,
                       .seed = std::numeric_limits<unsigned long>::max(),
                       .rms_error_mm = 12.345678901234567};
  return dictionary;
}

std::string BytesOf(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << stream.rdbuf();
  return bytes.str();
}

std::string BytesOf(const Dictionary& dictionary) {
  const auto path = ScratchDir() / "written.pldict";
  WriteDictionary(dictionary, path);
  return BytesOf(path);
}

std::string RefusalOf(const std::filesystem::path& path) {
  try {
    ReadDictionary(path);
    return "not refused";
  } catch (const InputError& error) {
    return error.what();
  }
}

std::string Refusal(const std::string& bytes) {
  return RefusalOf(WriteScratch("refused.pldict", bytes));
}

// Changes the file in place: thousands of new files would take minutes.
void FlipByte(const std::filesystem::path& path, size_t offset, int flip) {
  std::fstream stream(path, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(offset));
  const int flipped = stream.get() ^ flip;
  stream.seekp(static_cast<std::streamoff>(offset));
  stream.put(static_cast<char>(flipped));
}

void SetU64(std::string* bytes, size_t offset, std::uint64_t value) {
  std::memcpy(bytes->data() + offset, &value, sizeof value);
}

// The checksum of what is there now: the file lies, but is not damaged.
std::string Sealed(std::string bytes) {
  bytes.resize(bytes.size() - kChecksumBytes);
  const auto checksum = static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
  bytes.append(reinterpret_cast<const char*>(&checksum), sizeof checksum);
  return bytes;
}

size_t ArraysAt(size_t header_bytes) { return (kHeaderAt + header_bytes + 63) / 64 * 64; }

std::string HeaderOf(const std::string& bytes) {
  std::uint64_t header_bytes = 0;
  std::memcpy(&header_bytes, bytes.data() + kHeaderBytesAt, sizeof header_bytes);
  return bytes.substr(kHeaderAt, header_bytes);
}

// The file with another header.
std::string WithHeader(const std::string& bytes, const std::string& header) {
  const std::string arrays = bytes.substr(ArraysAt(HeaderOf(bytes).size()));
  std::string changed = bytes.substr(0, kHeaderAt) + header;
  changed.resize(ArraysAt(header.size()));
  changed += arrays;
  SetU64(&changed, kHeaderBytesAt, header.size());
  SetU64(&changed, kFileBytesAt, changed.size());
  return Sealed(changed);
}

// Why the file is refused when one value of its header is another.
std::string RefusalWith(const std::string& pointer, const nlohmann::ordered_json& value) {
  auto rng = TestRng();
  const std::string bytes = BytesOf(RandomDictionary(2, &rng));
  auto header = nlohmann::ordered_json::parse(HeaderOf(bytes));
  header.at(nlohmann::ordered_json::json_pointer(pointer)) = value;
  return Refusal(WithHeader(bytes, header.dump()));
}

// The same with one number of the first atom.
std::string RefusalWithAtomNumber(double value) {
  auto rng = TestRng();
  std::string bytes = BytesOf(RandomDictionary(2, &rng));
  std::memcpy(bytes.data() + ArraysAt(HeaderOf(bytes).size()) + 5 * sizeof value, &value,
              sizeof value);
  return Refusal(Sealed(bytes));
}

::testing::AssertionResult SameBits(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  const bool same = a.rows() == b.rows() && a.cols() == b.cols() &&
                    std::memcmp(a.data(), b.data(), sizeof(double) * a.size()) == 0;
  return same ? ::testing::AssertionSuccess() : ::testing::AssertionFailure() << "bits differ";
}

void ExpectSameSkeleton(const Skeleton& a, const Skeleton& b) {
  EXPECT_EQ(a.name, b.name);
  ASSERT_EQ(a.bones.size(), b.bones.size());
  for (size_t i = 0; i < a.bones.size(); ++i) {
    EXPECT_EQ(a.bones[i].name, b.bones[i].name);
    EXPECT_EQ(a.bones[i].parent, b.bones[i].parent);
    EXPECT_TRUE(SameBits(a.bones[i].offset_m, b.bones[i].offset_m));
    EXPECT_TRUE(SameBits(a.bones[i].tip_m, b.bones[i].tip_m));
    EXPECT_TRUE(SameBits(a.bones[i].rest_from_axis, b.bones[i].rest_from_axis));
    ASSERT_EQ(a.bones[i].dofs.size(), b.bones[i].dofs.size());
    for (size_t d = 0; d < a.bones[i].dofs.size(); ++d) {
      EXPECT_EQ(a.bones[i].dofs[d].kind, b.bones[i].dofs[d].kind);
      EXPECT_EQ(a.bones[i].dofs[d].lower, b.bones[i].dofs[d].lower);
      EXPECT_EQ(a.bones[i].dofs[d].upper, b.bones[i].dofs[d].upper);
    }
  }
}

TEST(DictionaryFile, GivesBackEveryBit) {
  const Dictionary written = WithPriorAndRecord(37);
  WriteDictionary(written, ScratchDir() / "a.pldict");
  const Dictionary read = ReadDictionary(ScratchDir() / "a.pldict");
  EXPECT_TRUE(SameBits(read.atoms, written.atoms));
  EXPECT_TRUE(SameBits(read.prior.mean_m, written.prior.mean_m));
  EXPECT_TRUE(SameBits(read.prior.whitening, written.prior.whitening));
  EXPECT_EQ(read.typical_norm_m, written.typical_norm_m);
  ExpectSameSkeleton(read.skeleton, written.skeleton);
  EXPECT_EQ(read.record.sources, written.record.sources);
  EXPECT_EQ(read.record.command, written.record.command);
  EXPECT_EQ(read.record.commit, written.record.commit);
  EXPECT_EQ(read.record.num_poses, written.record.num_poses);
  EXPECT_EQ(read.record.mirrored, written.record.mirrored);
  EXPECT_EQ(read.record.sparsity, written.record.sparsity);
  EXPECT_EQ(read.record.num_subsets, written.record.num_subsets);
  EXPECT_EQ(read.record.seed, written.record.seed);
  EXPECT_EQ(read.record.rms_error_mm, written.record.rms_error_mm);
}

TEST(DictionaryFile, GivesTheSameBytesForTheSameDictionary) {
  const std::string bytes = BytesOf(WithPriorAndRecord(5));
  EXPECT_EQ(BytesOf(WithPriorAndRecord(5)), bytes);
  EXPECT_EQ(BytesOf(ReadDictionary(WriteScratch("again.pldict", bytes))), bytes);
}

TEST(DictionaryFile, MayLackThePrior) {
  auto rng = TestRng();
  const std::string bytes = BytesOf(RandomDictionary(1, &rng));
  const Dictionary read = ReadDictionary(WriteScratch("a.pldict", bytes));
  EXPECT_TRUE(read.prior.Empty());
  EXPECT_EQ(read.NumAtoms(), 1);
  EXPECT_FALSE(read.record.mirrored);
}

TEST(DictionaryFile, ReplacesWhatIsNotUtf8) {
  auto rng = TestRng();
  Dictionary dictionary = RandomDictionary(1, &rng);
  dictionary.record.sources = {"\xFF.amc"};
  const Dictionary read = ReadDictionary(WriteScratch("a.pldict", BytesOf(dictionary)));
  EXPECT_THAT(read.record.sources, ElementsAre("\xEF\xBF\xBD.amc"));
}

TEST(DictionaryFile, IsRefusedWithAnyByteAltered) {
  auto rng = TestRng();
  const auto path = ScratchDir() / "altered.pldict";
  WriteDictionary(RandomDictionary(1, &rng), path);
  for (size_t i = 0; i < std::filesystem::file_size(path); ++i)
    for (const int flip : {0x01, 0x80, 0xFF}) {
      FlipByte(path, i, flip);
      EXPECT_NE(RefusalOf(path), "not refused") << "byte " << i;
      FlipByte(path, i, flip);
    }
  EXPECT_EQ(RefusalOf(path), "not refused");
}

TEST(DictionaryFile, IsRefusedAtAnyOtherLength) {
  auto rng = TestRng();
  const auto path = ScratchDir() / "cut.pldict";
  WriteDictionary(RandomDictionary(1, &rng), path);
  const std::string bytes = BytesOf(path);
  for (size_t size = bytes.size() - 1; size > 0; --size) {
    std::filesystem::resize_file(path, size);
    EXPECT_THAT(RefusalOf(path), HasSubstr("is cut short")) << size;
  }
  EXPECT_THAT(Refusal(""), HasSubstr("empty"));
  EXPECT_THAT(Refusal(bytes + '\0'), HasSubstr("is altered"));
}

TEST(DictionaryFile, SaysWhatAStrangeFileIs) {
  const std::string bytes = BytesOf(WithPriorAndRecord(1));
  EXPECT_THAT(Refusal("HIERARCHY\nROOT Hips"), HasSubstr("is no dictionary"));
  std::string as_text = bytes;
  as_text.erase(6, 1);  // \r\n to \n
  EXPECT_THAT(Refusal(as_text), HasSubstr("transfer as text"));
  std::string newer = bytes;
  newer[kVersionAt] = 2;
  EXPECT_THAT(Refusal(newer), AllOf(HasSubstr("version 2, wanted 1"), HasSubstr("newer")));
  newer[kVersionAt] = 0;
  EXPECT_THAT(Refusal(newer), AllOf(HasSubstr("version 0, wanted 1"), Not(HasSubstr("newer"))));
  std::string altered = bytes;
  altered[bytes.size() / 2] ^= 1;
  EXPECT_THAT(Refusal(altered), HasSubstr("checksum"));
  EXPECT_THROW(ReadDictionary(ScratchDir()), InputError);
  EXPECT_THROW(ReadDictionary(ScratchDir() / "absent.pldict"), InputError);
}

TEST(DictionaryFile, DoesNotBelieveALongHeader) {
  auto rng = TestRng();
  const std::string bytes = BytesOf(RandomDictionary(1, &rng));
  for (const std::uint64_t length :
       {std::uint64_t{bytes.size()} - kHeaderAt - kChecksumBytes + 1, std::uint64_t{1} << 31,
        std::uint64_t{1} << 32, std::uint64_t{1} << 63, ~std::uint64_t{0}}) {
    std::string lying = bytes;
    SetU64(&lying, kHeaderBytesAt, length);
    EXPECT_THAT(Refusal(Sealed(lying)), HasSubstr("has a header of")) << length;
  }
  EXPECT_THAT(Refusal(WithHeader(bytes, std::string(5'000'000, '['))),
              HasSubstr("wanted at most 4194304"));
}

TEST(DictionaryFile, DoesNotBelieveItsArrayTable) {
  for (const double offset : {64.0, 8.0, 1e6, 9007199254740992.0})
    EXPECT_THAT(RefusalWith("/arrays/atoms/offset", offset), HasSubstr("array atoms at byte"));
  EXPECT_THAT(RefusalWith("/arrays/atoms/offset", -64), HasSubstr("found -64"));
  EXPECT_THAT(RefusalWith("/arrays/atoms/offset", 0.5), HasSubstr("whole number"));
  EXPECT_THAT(RefusalWith("/arrays/atoms/cols", 3), HasSubstr("leaves room"));
  EXPECT_THAT(RefusalWith("/arrays/atoms/cols", 2147483647), HasSubstr("leaves room"));
  EXPECT_THAT(RefusalWith("/arrays/atoms/cols", 0), HasSubstr("69 x 0"));
  EXPECT_THAT(RefusalWith("/arrays/atoms/cols", 1e19), HasSubstr("found 1e+19"));
  EXPECT_THAT(RefusalWith("/arrays/atoms/rows", 68), HasSubstr("68 x 2, wanted 69 x any"));
  EXPECT_THAT(RefusalWith("/arrays/atoms/type", "float32"), HasSubstr("wanted float64"));
  EXPECT_THAT(RefusalWith("/arrays", nlohmann::ordered_json::object()),
              HasSubstr("has no array atoms"));
  const nlohmann::ordered_json mean = {
      {"type", "float64"}, {"rows", 69}, {"cols", 1}, {"offset", 0}};
  const nlohmann::ordered_json atoms = {
      {"type", "float64"}, {"rows", 69}, {"cols", 2}, {"offset", 0}};
  EXPECT_THAT(RefusalWith("/arrays", {{"atoms", atoms}, {"prior_mean_m", mean}}),
              HasSubstr("has no array prior_whitening"));
}

TEST(DictionaryFile, WantsFiniteAtomsOfUnitNorm) {
  EXPECT_THAT(RefusalWithAtomNumber(7.0), HasSubstr("atom 0 has norm 7"));
  for (const double value : {std::numeric_limits<double>::quiet_NaN(), kInfinity, 1e300})
    EXPECT_THAT(RefusalWithAtomNumber(value), HasSubstr("atom 0 has norm")) << value;
}

TEST(DictionaryFile, WantsTheJointsInTheirOrder) {
  EXPECT_THAT(RefusalWith("/joint_names/1", "right_hip"),
              AllOf(HasSubstr("joint_names[1]"), HasSubstr("wanted left_hip")));
  EXPECT_THAT(RefusalWith("/joint_names", {"pelvis"}), HasSubstr("23 joint names"));
}

TEST(DictionaryFile, WantsASoundSkeleton) {
  EXPECT_THAT(RefusalWith("/skeleton/bones/3/parent", 4), HasSubstr("ltibia has parent 4"));
  EXPECT_THAT(RefusalWith("/skeleton/bones/3/parent", 23), HasSubstr("found 23"));
  EXPECT_THAT(RefusalWith("/skeleton/bones/3/parent", -2), HasSubstr("found -2"));
  EXPECT_THAT(RefusalWith("/skeleton/bones/3/name", "rtibia"), HasSubstr("wanted ltibia"));
  EXPECT_THAT(RefusalWith("/skeleton/bones/3/tip_m/1", 1e9), HasSubstr("beyond 10 m"));
  EXPECT_THAT(RefusalWith("/skeleton/bones/3/offset_m", {1, 2}), HasSubstr("list of 3 numbers"));
  EXPECT_THAT(RefusalWith("/skeleton/bones/3/rest_from_axis/0/0", 0.5), HasSubstr("no rotation"));
  EXPECT_THAT(RefusalWith("/skeleton/bones/1/rest_from_axis/0/0", -1), HasSubstr("no rotation"));
  EXPECT_THAT(RefusalWith("/skeleton/bones", nlohmann::ordered_json::array()),
              HasSubstr("23 bones"));
}

TEST(DictionaryFile, WantsSoundDegreesOfFreedom) {
  const std::string dof = "/skeleton/bones/2/dofs/0";
  EXPECT_THAT(RefusalWith(dof + "/kind", "sx"), HasSubstr("wanted rx, ry, rz, tx, ty or tz"));
  EXPECT_THAT(RefusalWith(dof + "/lower", 3.0), HasSubstr("limits in order"));
  EXPECT_THAT(RefusalWith(dof + "/upper", 1e300), HasSubstr("limits in order"));
  EXPECT_THAT(RefusalWith(dof + "/upper", "1"), HasSubstr("wanted a number"));
  const nlohmann::ordered_json rx = {{"kind", "rx"}};
  EXPECT_THAT(RefusalWith("/skeleton/bones/0/dofs", nlohmann::ordered_json::array({rx})),
              HasSubstr("wanted at most 0"));
  EXPECT_THAT(RefusalWith("/skeleton/bones/2/dofs", {rx, rx, rx, rx, rx, rx, rx}),
              HasSubstr("wanted at most 6"));
}

TEST(DictionaryFile, WantsASoundRecord) {
  EXPECT_THAT(RefusalWith("/typical_norm_m", 0), HasSubstr("typical norm"));
  EXPECT_THAT(RefusalWith("/typical_norm_m", 1e30), HasSubstr("typical norm"));
  EXPECT_THAT(RefusalWith("/training/num_poses", -1), HasSubstr("training.num_poses"));
  EXPECT_THAT(RefusalWith("/training/sparsity", 1e12), HasSubstr("training.sparsity"));
  EXPECT_THAT(RefusalWith("/training/seed", "12x"), HasSubstr("training.seed"));
  EXPECT_THAT(RefusalWith("/training/seed", 12), HasSubstr("wanted a string"));
  EXPECT_THAT(RefusalWith("/training/rms_error_mm", -1), HasSubstr("error of -1 mm"));
  EXPECT_THAT(RefusalWith("/training/augmentation", {"turned"}), HasSubstr("mirrored"));
  EXPECT_THAT(RefusalWith("/training", nullptr), HasSubstr("found no \"training\""));
}

TEST(DictionaryFile, RefusesAHeaderThatIsNoJson) {
  auto rng = TestRng();
  const std::string bytes = BytesOf(RandomDictionary(1, &rng));
  for (const char* header : {"", "{", "[]", "null", "{\"joint_names\": 1e999}", "\xFF"})
    EXPECT_THAT(Refusal(WithHeader(bytes, header)), HasSubstr("(header)")) << header;
}

TEST(DictionaryFile, IsNotWrittenWithAFlaw) {
  auto rng = TestRng();
  const Dictionary sound = RandomDictionary(2, &rng);
  const auto path = ScratchDir() / "flawed.pldict";
  Dictionary flawed = sound;
  flawed.atoms(3, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(WriteDictionary(flawed, path), std::invalid_argument);
  flawed = sound;
  flawed.prior.mean_m.setZero(69);
  EXPECT_THROW(WriteDictionary(flawed, path), std::invalid_argument);
  flawed = sound;
  flawed.prior.mean_m.setZero(69);
  flawed.prior.whitening.setConstant(69, 69, kInfinity);
  EXPECT_THROW(WriteDictionary(flawed, path), std::invalid_argument);
  flawed = sound;
  flawed.skeleton.bones[5].dofs = {{Dof::Kind::kRx, kInfinity, kInfinity}};
  EXPECT_THROW(WriteDictionary(flawed, path), std::invalid_argument);
  flawed = sound;
  flawed.record.command.assign(5'000'000, 'a');
  EXPECT_THROW(WriteDictionary(flawed, path), InputError);
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(DictionaryFile, IsNotWrittenToAFolder) {
  auto rng = TestRng();
  EXPECT_THROW(WriteDictionary(RandomDictionary(1, &rng), ScratchDir()), InputError);
  EXPECT_THROW(WriteDictionary(RandomDictionary(1, &rng), ScratchDir() / "no/such.pldict"),
               InputError);
}

}  // namespace
}  // namespace poselift
