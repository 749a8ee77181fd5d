// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "src/io/body_tags_toml.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <initializer_list>

#include "src/body_segments.h"
#include "src/input_error.h"
#include "src/io/atomic_file.h"
#include "src/io/body_tags_formats.h"
#include "src/io/text_scanner.h"
#include "src/io/toml_file.h"
#include "src/joints.h"
#include "src/nearest_names.h"
#include "src/units.h"

namespace poselift {
namespace {

constexpr double kMetresFromMm = 1e-3;
constexpr double kLargestSigma_mm = 1000.0, kLargestSigma_deg = 180.0;
constexpr double kUnitTolerance = 0.01;  // of a rotation's length

struct NamedFacing {
  TagFacing faces;
  const char* name;
};
constexpr NamedFacing kFacings[] = {{TagFacing::kFront, "front"},
                                    {TagFacing::kBack, "back"},
                                    {TagFacing::kLeft, "left"},
                                    {TagFacing::kRight, "right"},
                                    {TagFacing::kUp, "up"}};

// One table of the file, with where it stands for errors.
class Table {
 public:
  Table(const toml::table& table, std::string file) : table_(&table), file_(std::move(file)) {}

  InputError Error(const std::string& message) const { return ErrorAt(*table_, message); }
  InputError ErrorAt(const toml::node& node, const std::string& message) const {
    return {file_, static_cast<int>(node.source().begin.line), message};
  }

  const toml::node* Find(std::string_view key) const { return table_->get(key); }
  bool Has(std::string_view key) const { return Find(key) != nullptr; }
  const std::string& file() const { return file_; }

  void CheckKeys(std::initializer_list<const char*> known) const {
    const std::vector<std::string> names(known.begin(), known.end());
    for (const auto& [key, node] : *table_)
      if (std::find(names.begin(), names.end(), key.str()) == names.end())
        throw ErrorAt(node, fmt::format("found the unknown key {}, {}", Quoted(key.str()),
                                        WantedPerhaps(key.str(), names)));
  }

  std::string String(std::string_view key) const {
    const toml::node& node = Wanted(key, "a text in quotes");
    const auto* text = node.as_string();
    if (!text) throw Unwanted(node, key, "a text in quotes");
    return text->get();
  }

  int Integer(std::string_view key, int largest) const {
    const std::string wanted = fmt::format("a whole number from 0 to {}", largest);
    const toml::node& node = Wanted(key, wanted);
    const auto* number = node.as_integer();
    if (!number || number->get() < 0 || number->get() > largest) throw Unwanted(node, key, wanted);
    return static_cast<int>(number->get());
  }

  double Number(std::string_view key, double least, double largest) const {
    const std::string wanted = fmt::format("a number from {} to {}", least, largest);
    return NumberOf(Wanted(key, wanted), key, least, largest, wanted);
  }

  template <int kSize>
  Eigen::Matrix<double, kSize, 1> Vector(std::string_view key, double largest) const {
    const std::string wanted = fmt::format("{} numbers in brackets, up to {}", kSize, largest);
    const toml::node& node = Wanted(key, wanted);
    const toml::array* list = node.as_array();
    if (!list || list->size() != kSize) throw Unwanted(node, key, wanted);
    Eigen::Matrix<double, kSize, 1> vector;
    for (int i = 0; i < kSize; ++i)
      vector[i] = NumberOf(*list->get(static_cast<size_t>(i)), key, -largest, largest, wanted);
    return vector;
  }

  InputError Unwanted(const toml::node& node, std::string_view key, std::string_view wanted) const {
    return ErrorAt(node, fmt::format("{}: wanted {}", key, wanted));
  }

 private:
  const toml::node& Wanted(std::string_view key, std::string_view wanted) const {
    if (const toml::node* node = Find(key)) return *node;
    throw Error(fmt::format("{} is missing, wanted {}", key, wanted));
  }

  double NumberOf(const toml::node& node, std::string_view key, double least, double largest,
                  std::string_view wanted) const {
    const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value || !(*value >= least && *value <= largest)) throw Unwanted(node, key, wanted);
    return *value;
  }

  const toml::table* table_;
  std::string file_;
};

double Sigma_m(const Table& table, std::string_view key, double otherwise_m) {
  return table.Has(key) ? table.Number(key, 0.01, kLargestSigma_mm) * kMetresFromMm : otherwise_m;
}

TagFacing ReadFacing(const Table& table) {
  const std::string name = table.String("faces");
  for (const NamedFacing& facing : kFacings)
    if (name == facing.name) return facing.faces;
  throw table.Unwanted(*table.Find("faces"), "faces",
                       "\"front\", \"back\", \"left\", \"right\" or \"up\", found " + Quoted(name));
}

TagOnJoint ReadOnJoint(const Table& table) {
  TagOnJoint on_joint;
  const std::string name = table.String("joint");
  const std::optional<int> joint = FindJoint(name);
  if (!joint)
    throw table.ErrorAt(*table.Find("joint"),
                        fmt::format("found the unknown joint {}, {}", Quoted(name),
                                    WantedPerhaps(name, JointNames())));
  on_joint.joint = Joints()[static_cast<size_t>(*joint)].name;
  if (table.Has("joint_in_tag_mm"))
    on_joint.joint_in_tag_m =
        table.Vector<3>("joint_in_tag_mm", kFarthestFromTag_m / kMetresFromMm) * kMetresFromMm;
  on_joint.sigma_m = Sigma_m(table, "joint_sigma_mm", on_joint.sigma_m);
  if (table.Has("faces")) on_joint.faces = ReadFacing(table);
  return on_joint;
}

TagOnBone ReadOnBone(const Table& table) {
  TagOnBone on_bone;
  const std::string name = table.String("bone");
  const std::optional<std::string> bone = FindBodyBone(name);
  if (!bone)
    throw table.ErrorAt(*table.Find("bone"),
                        fmt::format("found the unknown bone {}, {}", Quoted(name),
                                    WantedPerhaps(name, BoneNames())));
  on_bone.bone = *bone;
  on_bone.bone_from_tag.translation() =
      table.Vector<3>("position_mm", kFarthestFromTag_m / kMetresFromMm) * kMetresFromMm;
  const Eigen::Vector4d wxyz = table.Vector<4>("rotation", 1.0 + kUnitTolerance);
  if (!(std::abs(wxyz.norm() - 1.0) < kUnitTolerance))
    throw table.Unwanted(*table.Find("rotation"), "rotation",
                         fmt::format("[w, x, y, z] of length 1, found {:.3g}", wxyz.norm()));
  on_bone.bone_from_tag.linear() =
      Eigen::Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]).normalized().toRotationMatrix();
  on_bone.sigma_m = Sigma_m(table, "position_sigma_mm", on_bone.sigma_m);
  if (table.Has("rotation_sigma_deg"))
    on_bone.sigma_rad = table.Number("rotation_sigma_deg", 0.01, kLargestSigma_deg) * kRadFromDeg;
  return on_bone;
}

// Keys of one place are refused without it: they would be passed over.
void CheckBelongings(const Table& table, std::string_view place,
                     std::initializer_list<const char*> belongings) {
  if (table.Has(place)) return;
  for (const char* key : belongings)
    if (table.Has(key))
      throw table.ErrorAt(*table.Find(key),
                          fmt::format("found {} without {}, wanted both", key, place));
}

BodyTag ReadTag(const Table& table, std::optional<double> size_mm) {
  table.CheckKeys({"id", "size_mm", "name", "joint", "joint_in_tag_mm", "joint_sigma_mm", "faces",
                   "bone", "position_mm", "rotation", "position_sigma_mm", "rotation_sigma_deg"});
  CheckBelongings(table, "joint", {"joint_in_tag_mm", "joint_sigma_mm", "faces"});
  CheckBelongings(table, "bone",
                  {"position_mm", "rotation", "position_sigma_mm", "rotation_sigma_deg"});
  BodyTag tag;
  tag.id = table.Integer("id", kLargestTagId);
  if (table.Has("size_mm") || !size_mm)
    size_mm =
        table.Number("size_mm", kSmallestTag_m / kMetresFromMm, kLargestTag_m / kMetresFromMm);
  tag.size_m = *size_mm * kMetresFromMm;
  if (table.Has("name")) tag.name = table.String("name");
  if (table.Has("joint")) tag.on_joint = ReadOnJoint(table);
  if (table.Has("bone")) tag.on_bone = ReadOnBone(table);
  if (!tag.on_joint && !tag.on_bone)
    throw table.Error(fmt::format(
        "the tag {} sits nowhere, wanted joint = \"left_knee\" or bone = \"left_shin\"", tag.id));
  return tag;
}

void ReadTags(const Table& file, BodyTags* tags) {
  std::optional<double> size_mm;
  if (file.Has("size_mm"))
    size_mm = file.Number("size_mm", kSmallestTag_m / kMetresFromMm, kLargestTag_m / kMetresFromMm);
  const toml::node* node = file.Find("tag");
  const toml::array* list = node ? node->as_array() : nullptr;
  if (!list || list->empty() || !list->is_homogeneous<toml::table>())
    throw node ? file.Unwanted(*node, "tag", "[[tag]] before each tag")
               : file.Error("found no tags, wanted [[tag]] before each tag");
  for (const toml::node& entry : *list) {
    const Table table(*entry.as_table(), file.file());
    BodyTag tag = ReadTag(table, size_mm);
    if (tags->Find(tag.id))
      throw table.Error(fmt::format("found the tag {} twice, wanted ids that differ", tag.id));
    tags->tags.push_back(std::move(tag));
  }
}

void ReadBoneLengths(const Table& file, BodyTags* tags) {
  const toml::node* node = file.Find("bone_lengths_mm");
  if (!node) return;
  if (!node->is_table())
    throw file.Unwanted(*node, "bone_lengths_mm", "a table, [bone_lengths_mm]");
  const Table lengths(*node->as_table(), file.file());
  for (const auto& [key, value] : *node->as_table()) {
    const std::optional<int> joint = FindJoint(key.str());
    if (!joint)
      throw lengths.ErrorAt(value, fmt::format("found the unknown joint {}, {}", Quoted(key.str()),
                                               WantedPerhaps(key.str(), JointNames())));
    const std::string name(Joints()[static_cast<size_t>(*joint)].name);
    for (const auto& [other, length_m] : tags->bone_lengths_m)
      if (other == name)
        throw lengths.ErrorAt(value, fmt::format("found the bone of {} twice", name));
    tags->bone_lengths_m.emplace_back(
        name, lengths.Number(key.str(), 1.0, kFarthestFromTag_m / kMetresFromMm) * kMetresFromMm);
  }
}

// The shortest decimals that are read as the same number of SI units again, if any are.
std::string Decimals(double value_si, double per_si, double (*si_from_unit)(double)) {
  std::string text;
  for (int digits = 12; digits <= 17; ++digits) {
    text = fmt::format("{:.{}g}", value_si * per_si, digits);
    if (si_from_unit(std::stod(text)) == value_si) break;
  }
  return text;
}

std::string Mm(double value_m) {
  return Decimals(value_m, 1e3, [](double mm) { return mm * kMetresFromMm; });
}

std::string Deg(double value_rad) {
  return Decimals(value_rad, kDegFromRad, [](double deg) { return deg * kRadFromDeg; });
}

std::string MmVector(const Eigen::Vector3d& value_m) {
  return fmt::format("[{}, {}, {}]", Mm(value_m.x()), Mm(value_m.y()), Mm(value_m.z()));
}

// A TOML basic string.
std::string TomlText(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      quoted += {'\\', c};
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)
      quoted += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    else
      quoted += c;
  }
  return quoted + '"';
}

std::string TagToml(const BodyTag& tag) {
  std::string text = fmt::format("\n[[tag]]\nid = {}\nsize_mm = {}\n", tag.id, Mm(tag.size_m));
  if (!tag.name.empty()) text += fmt::format("name = {}\n", TomlText(tag.name));
  if (tag.on_joint)
    text += fmt::format("joint = {}\njoint_in_tag_mm = {}\njoint_sigma_mm = {}\n",
                        TomlText(tag.on_joint->joint), MmVector(tag.on_joint->joint_in_tag_m),
                        Mm(tag.on_joint->sigma_m));
  if (tag.on_joint && tag.on_joint->faces)
    for (const NamedFacing& facing : kFacings)
      if (facing.faces == *tag.on_joint->faces)
        text += fmt::format("faces = \"{}\"\n", facing.name);
  if (tag.on_bone) {
    const TagOnBone& on_bone = *tag.on_bone;
    const Eigen::Quaterniond q(on_bone.bone_from_tag.linear());
    text += fmt::format(
        "bone = {}\nposition_mm = {}\nrotation = [{}, {}, {}, {}]\n"
        "position_sigma_mm = {}\nrotation_sigma_deg = {}\n",
        TomlText(SegmentName(on_bone.bone)), MmVector(on_bone.bone_from_tag.translation()), q.w(),
        q.x(), q.y(), q.z(), Mm(on_bone.sigma_m), Deg(on_bone.sigma_rad));
  }
  return text;
}

}  // namespace

std::vector<std::string> JointNames() {
  std::vector<std::string> names = {"neck", "head"};
  for (const JointInfo& joint : Joints()) names.emplace_back(joint.name);
  return names;
}

std::vector<std::string> BoneNames() {
  std::vector<std::string> names;
  for (const BodySegment& segment : BodySegments()) names.emplace_back(segment.name);
  for (const JointInfo& joint : Joints()) names.emplace_back(joint.cmu_bone);
  return names;
}

std::string WantedPerhaps(std::string_view name, const std::vector<std::string>& names) {
  return fmt::format("wanted perhaps \"{}\"", NearestNames(name, names, 1).front());
}

BodyTags ReadBodyTagsToml(const std::filesystem::path& path) {
  const toml::table root =
      ReadToml(path, "a tags file, as `poselift tags print --set body` writes one");
  const Table file(root, path.string());
  file.CheckKeys({"family", "size_mm", "tag", "bone_lengths_mm"});
  BodyTags tags;
  if (file.Has("family")) tags.family = file.String("family");
  ReadTags(file, &tags);
  ReadBoneLengths(file, &tags);
  return tags;
}

BodyTags ReadBodyTags(const std::filesystem::path& path, TagPlaces places) {
  const std::string ending = path.extension().string();
  return EqualsIgnoringCase(ending, ".yaml") || EqualsIgnoringCase(ending, ".yml")
             ? ReadBodyTagsRos(path, places)
             : ReadBodyTagsToml(path);
}

std::string BodyTagsToml(const BodyTags& tags) {
  std::string text = fmt::format("family = {}\n", TomlText(tags.family));
  for (const BodyTag& tag : tags.tags) text += TagToml(tag);
  if (!tags.bone_lengths_m.empty()) text += "\n[bone_lengths_mm]\n";
  for (const auto& [joint, length_m] : tags.bone_lengths_m)
    text += fmt::format("{} = {}\n", joint, Mm(length_m));
  return text;
}

void WriteBodyTags(const BodyTags& tags, const std::filesystem::path& path) {
  WriteFileAtomically(path, BodyTagsToml(tags));
}

}  // namespace poselift
