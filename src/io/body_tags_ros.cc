// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// The tags.yaml of apriltag_ros: metres, a tag's y up and z out of the paper, a bundle's tags in
// the bundle's frame. Its names are free there: `joint` or `bone` beside them, which apriltag_ros
// passes over, says what is meant.
#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <cmath>

#include "src/body_segments.h"
#include "src/input_error.h"
#include "src/io/body_tags_formats.h"
#include "src/io/text_scanner.h"
#include "src/joints.h"

namespace poselift {
namespace {

constexpr double kUnitTolerance = 0.01;

class Reader {
 public:
  Reader(std::string file, TagPlaces places) : file_(std::move(file)), places_(places) {}

  BodyTags Read(const YAML::Node& root) {
    if (!root.IsMap() || !(root["standalone_tags"] || root["tag_bundles"]))
      throw Error(root, "found no tags, wanted standalone_tags or tag_bundles");
    for (const YAML::Node& tag : Items(root, "standalone_tags")) ReadStandalone(tag);
    for (const YAML::Node& bundle : Items(root, "tag_bundles")) ReadBundle(bundle);
    if (tags_.tags.empty()) throw Error(root, "found no tags in the lists");
    return std::move(tags_);
  }

 private:
  InputError Error(const YAML::Node& node, const std::string& message) const {
    const YAML::Mark mark = node.IsDefined() ? node.Mark() : YAML::Mark();
    return {file_, mark.line < 0 ? 1 : mark.line + 1, message};
  }

  YAML::Node Items(const YAML::Node& map, const char* key) const {
    const YAML::Node items = map[key];
    if (!items || items.IsNull()) return YAML::Node(YAML::NodeType::Sequence);
    if (!items.IsSequence()) throw Error(items, fmt::format("{}: wanted a list", key));
    return items;
  }

  template <class T>
  T Value(const YAML::Node& map, const char* key, const char* wanted) const {
    if (!map.IsMap()) throw Error(map, fmt::format("wanted a map with {}", key));
    const YAML::Node node = map[key];
    T value;
    if (!node) throw Error(map, fmt::format("{} is missing, wanted {}", key, wanted));
    if (!YAML::convert<T>::decode(node, value))
      throw Error(node, fmt::format("{}: wanted {}", key, wanted));
    return value;
  }

  double Number(const YAML::Node& map, const char* key, double otherwise) const {
    if (map.IsMap() && !map[key]) return otherwise;
    const auto value = Value<double>(map, key, "a number");
    if (!(std::abs(value) <= kFarthestFromTag_m))
      throw Error(map[key], fmt::format("{}: wanted a number up to {}", key, kFarthestFromTag_m));
    return value;
  }

  BodyTag IdAndSize(const YAML::Node& map) const {
    BodyTag tag;
    tag.id = Value<int>(map, "id", "a whole number");
    if (tag.id < 0 || tag.id > kLargestTagId)
      throw Error(map["id"], fmt::format("id: wanted 0 to {}", kLargestTagId));
    tag.size_m = Value<double>(map, "size", "metres");
    if (!(tag.size_m >= kSmallestTag_m && tag.size_m <= kLargestTag_m))
      throw Error(map["size"],
                  fmt::format("size: wanted metres, {} to {}", kSmallestTag_m, kLargestTag_m));
    if (tags_.Find(tag.id))
      throw Error(map, fmt::format("found the tag {} twice, wanted ids that differ", tag.id));
    return tag;
  }

  static std::string NoPlace(const std::string& place, const char* what, const char* beside,
                             const std::vector<std::string>& names) {
    return fmt::format(
        "found the unknown {} {}, {}. Names may stay as they are with {} beside them, one of: {}",
        what, Quoted(place), WantedPerhaps(place, names), beside, fmt::join(names, ", "));
  }

  // A tag alone says nothing of where on a bone it sits.
  void ReadStandalone(const YAML::Node& map) {
    BodyTag tag = IdAndSize(map);
    if (map["name"] || places_ == TagPlaces::kWanted)
      tag.name = Value<std::string>(map, "name", "the name of a joint");
    if (places_ == TagPlaces::kAny) return tags_.tags.push_back(std::move(tag));
    const char* const key = map["joint"] ? "joint" : "name";
    const auto place = Value<std::string>(map, key, "the name of a joint");
    const std::optional<int> joint = FindJoint(place);
    if (!joint)
      throw Error(map[key], FindBodyBone(place)
                                ? fmt::format("found the bone {} for a tag alone, wanted a joint, "
                                              "or a bundle of the bone's name that says where the "
                                              "tag sits",
                                              Quoted(place))
                                : NoPlace(place, "joint", "joint: NAME", JointNames()));
    tag.on_joint = TagOnJoint{.joint = std::string(Joints()[static_cast<size_t>(*joint)].name)};
    tags_.tags.push_back(std::move(tag));
  }

  // A bundle of a bone's name has the bone's frame, one of a joint's name its origin there.
  void ReadBundle(const YAML::Node& bundle) {
    const auto name = Value<std::string>(bundle, "name", "the name of a bone or a joint");
    if (places_ == TagPlaces::kAny) return ReadNames(bundle, name);
    const char* const key = bundle["bone"] ? "bone" : bundle["joint"] ? "joint" : "name";
    const auto place = Value<std::string>(bundle, key, "the name of a bone or a joint");
    const std::optional<std::string> bone = FindBodyBone(place);
    const std::optional<int> joint = FindJoint(place);
    if (!bone && !joint) {
      std::vector<std::string> names = BoneNames();
      for (const std::string& other : JointNames()) names.push_back(other);
      throw Error(bundle[key], NoPlace(place, "bone or joint", "bone: NAME or joint: NAME", names));
    }
    for (const YAML::Node& entry : Items(bundle, "layout")) {
      BodyTag tag = IdAndSize(entry);
      tag.name = name;
      const Eigen::Isometry3d bundle_from_tag = BundleFromTag(entry);
      if (bone)
        tag.on_bone = TagOnBone{.bone = *bone, .bone_from_tag = bundle_from_tag};
      else
        tag.on_joint = TagOnJoint{.joint = std::string(Joints()[static_cast<size_t>(*joint)].name),
                                  .joint_in_tag_m = bundle_from_tag.inverse().translation()};
      tags_.tags.push_back(std::move(tag));
    }
  }

  void ReadNames(const YAML::Node& bundle, const std::string& name) {
    for (const YAML::Node& entry : Items(bundle, "layout")) {
      tags_.tags.push_back(IdAndSize(entry));
      tags_.tags.back().name = name;
    }
  }

  Eigen::Isometry3d BundleFromTag(const YAML::Node& entry) const {
    const Eigen::Quaterniond turn(Number(entry, "qw", 1.0), Number(entry, "qx", 0.0),
                                  Number(entry, "qy", 0.0), Number(entry, "qz", 0.0));
    if (!(std::abs(turn.norm() - 1.0) < kUnitTolerance))
      throw Error(entry, fmt::format("qw, qx, qy, qz: wanted length 1, found {:.3g}", turn.norm()));
    Eigen::Isometry3d bundle_from_tag = Eigen::Isometry3d::Identity();
    bundle_from_tag.translation() =
        Eigen::Vector3d(Number(entry, "x", 0.0), Number(entry, "y", 0.0), Number(entry, "z", 0.0));
    const Eigen::DiagonalMatrix<double, 3> theirs_from_ours(1.0, -1.0, -1.0);
    bundle_from_tag.linear() = turn.normalized().toRotationMatrix() * theirs_from_ours;
    return bundle_from_tag;
  }

  std::string file_;
  TagPlaces places_;
  BodyTags tags_;
};

}  // namespace

BodyTags ReadBodyTagsRos(const std::filesystem::path& path, TagPlaces places) {
  try {
    return Reader(path.string(), places).Read(YAML::Load(ReadTextFile(path)));
  } catch (const YAML::Exception& error) {
    throw InputError(path.string(), error.mark.line < 0 ? 1 : error.mark.line + 1,
                     fmt::format("{}, wanted YAML", error.msg));
  }
}

}  // namespace poselift
