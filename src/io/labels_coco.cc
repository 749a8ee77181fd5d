// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// COCO keypoints: annotations, an object with the lists images, annotations and
// categories; and results, a bare list of {image_id, keypoints, score}. The
// keypoints are x0 y0 v0 x1 ..., v = 0 not labelled, 1 hidden, 2 visible; in
// results v is often a detector's score.
//
// COCO's annotators clicked whole pixels: x = 367 is the pixel of column 367,
// whose centre is 367 in our pixel coordinates too. Nothing is shifted.
#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "src/io/labels_formats.h"
#include "src/io/text_scanner.h"

namespace poselift {
namespace {

using Kind = JsonValue::Kind;

// The landmark each keypoint stands for, in the file's order.
struct KeypointOrder {
  const Layout* layout = nullptr;
  std::vector<std::string> names;
};

KeypointOrder OrderOf(const Layout& layout) {
  KeypointOrder order{&layout, {}};
  for (const Landmark& landmark : layout.landmarks) order.names.emplace_back(landmark.name);
  return order;
}

// "Left Knee" and "left-knee" are left_knee.
std::string PlainName(std::string name) {
  for (char& c : name)
    c = c == ' ' || c == '-' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name;
}

// The order that a category's list of names says, in the first layout that has
// them all.
KeypointOrder OrderFromNames(const JsonValue& keypoint_names) {
  KeypointOrder order;
  for (const JsonValue& name : keypoint_names.Items())
    order.names.push_back(PlainName(name.String()));
  std::vector<std::string> sorted = order.names;
  std::sort(sorted.begin(), sorted.end());
  if (const auto twin = std::adjacent_find(sorted.begin(), sorted.end()); twin != sorted.end())
    throw keypoint_names.Error("found the keypoint " + Quoted(*twin) + " twice, wanted it once");
  for (const Layout& layout : AllLayouts()) {
    const auto known = [&](const std::string& name) { return layout.Find(name).has_value(); };
    if (!std::all_of(order.names.begin(), order.names.end(), known)) continue;
    order.layout = &layout;
    return order;
  }
  throw keypoint_names.Error(fmt::format(
      "found keypoint names that no layout has together, wanted those of one of {}; or name the "
      "layout whose order they have",
      LayoutSizes()));
}

KeypointOrder OrderFromCount(const JsonValue& keypoints) {
  const Layout* layout = FindLayoutBySize(keypoints.Items().size() / 3);
  if (!layout || keypoints.Items().size() % 3 != 0)
    throw keypoints.Unwanted("three values (x, y, visibility) for each keypoint of a layout: " +
                             LayoutSizes());
  return OrderOf(*layout);
}

// "785" and 785 name the same image.
std::string ImageKey(const JsonValue& id) {
  if (id.Is(Kind::kString)) return id.String();
  return fmt::format("{}", id.Number());
}

class CocoReader {
 public:
  explicit CocoReader(const Layout* layout) : forced_layout_(layout) {}

  Labels Annotations(const JsonValue& root) {
    if (const JsonValue* images = root.Find("images"))
      for (const JsonValue& image : images->Items()) AddImage(image);
    if (const JsonValue* categories = root.Find("categories")) {
      for (const JsonValue& category : categories->Items()) {
        const JsonValue* names = category.Find("keypoints");
        if (!names || names->Items().empty() || forced_layout_ || order_.layout) continue;
        order_ = OrderFromNames(*names);
      }
    }
    return People(root.At("annotations"), true);
  }

  Labels Results(const JsonValue& root) { return People(root, false); }

 private:
  void AddImage(const JsonValue& image) {
    const std::string key = ImageKey(image.At("id"));
    if (!frame_of_image_.emplace(key, labels_.frames.size()).second)
      throw image.Error("found a second image with the id " + Quoted(key) + ", wanted one");
    FrameLabels frame;
    const JsonValue* name = image.Find("file_name");
    if (!name) name = image.Find("filename");
    if (name) frame.image = name->String();
    if (const JsonValue* width = image.Find("width"))
      frame.width_px = width->Integer(0, kLargestPicture_px);
    if (const JsonValue* height = image.Find("height"))
      frame.height_px = height->Integer(0, kLargestPicture_px);
    labels_.frames.push_back(std::move(frame));
  }

  Labels People(const JsonValue& people, bool images_are_listed) {
    third_is_score_ = ThirdIsScore(people, images_are_listed);
    bool any = false;
    for (const JsonValue& person : people.Items()) {
      const JsonValue* keypoints = person.Find("keypoints");
      if (!keypoints) continue;  // boxes and outlines of other tasks
      any = true;
      AddPerson(*keypoints, person, FrameOf(person.At("image_id"), images_are_listed));
    }
    if (!any) throw people.Error("found nothing with \"keypoints\", wanted COCO keypoints");
    labels_.layout = order_.layout->name;
    return std::move(labels_);
  }

  FrameLabels* FrameOf(const JsonValue& image_id, bool images_are_listed) {
    const auto [found, is_new] = frame_of_image_.emplace(ImageKey(image_id), labels_.frames.size());
    if (is_new) {
      if (images_are_listed) throw image_id.Unwanted("the id of one of the images");
      FrameLabels frame;
      if (image_id.Is(Kind::kString)) frame.image = image_id.String();  // AlphaPose
      labels_.frames.push_back(std::move(frame));
    }
    return &labels_.frames[found->second];
  }

  void AddPerson(const JsonValue& keypoints, const JsonValue& json, FrameLabels* frame) {
    if (!order_.layout)
      order_ = forced_layout_ ? OrderOf(*forced_layout_) : OrderFromCount(keypoints);
    const std::vector<JsonValue>& values = keypoints.Items();
    if (values.size() != 3 * order_.names.size())
      throw keypoints.Unwanted(fmt::format("{} values: x, y, visibility of {} keypoints",
                                           3 * order_.names.size(), order_.names.size()));
    PersonLabels person{static_cast<int>(frame->people.size()), {}};
    if (const JsonValue* track = json.Find("track_id"))
      person.id = track->Integer(-1, std::numeric_limits<int>::max());
    bool any = false;
    for (size_t k = 0; k < order_.names.size(); ++k) {
      person.landmarks.push_back(ReadKeypoint(order_.names[k], &values[3 * k]));
      any = any || person.landmarks.back().state != LabelState::kAbsent;
    }
    // COCO lists people whose joints nobody has labelled: crowds, tiny ones.
    if (any) frame->people.push_back(std::move(person));
  }

  LandmarkLabel ReadKeypoint(const std::string& name, const JsonValue* values) const {
    const Eigen::Vector2d x_px(values[0].Number(-kLargestCoordinate_px, kLargestCoordinate_px),
                               values[1].Number(-kLargestCoordinate_px, kLargestCoordinate_px));
    const double third = values[2].Number(0.0, 2.0);
    if (third_is_score_) return LandmarkFromScore(name, x_px, third);
    static constexpr LabelState kStates[] = {LabelState::kAbsent, LabelState::kOccluded,
                                             LabelState::kVisible};
    return {name, x_px, kStates[static_cast<int>(third)], std::nullopt};
  }

  // Scores when any third value is no whole number. In results a 1 is no sign
  // of a hidden joint either: the detectors that write it write it everywhere.
  static bool ThirdIsScore(const JsonValue& people, bool is_annotated) {
    if (!is_annotated) return true;
    for (const JsonValue& person : people.Items())
      if (const JsonValue* keypoints = person.Find("keypoints"))
        for (size_t i = 2; i < keypoints->Items().size(); i += 3) {
          const double third = keypoints->Items()[i].Number(0.0, 2.0);
          if (third != std::floor(third)) return true;
        }
    return false;
  }

  const Layout* forced_layout_;
  KeypointOrder order_;
  bool third_is_score_ = false;
  std::map<std::string, size_t> frame_of_image_;
  Labels labels_;
};

}  // namespace

bool IsCocoLabels(const JsonValue& root) {
  if (root.Is(Kind::kArray)) return true;
  return root.Is(Kind::kObject) && root.Find("annotations");
}

Labels ReadCocoLabels(const JsonValue& root, const Layout* layout) {
  CocoReader reader(layout);
  return root.Is(Kind::kArray) ? reader.Results(root) : reader.Annotations(root);
}

}  // namespace poselift
