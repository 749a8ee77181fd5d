// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "ui/live/live_inputs.h"

#include <memory>
#include <utility>

#include "src/capture/open_frame_source.h"
#include "src/io/body_tags_toml.h"
#include "src/io/camera_file.h"

namespace poselift {

void CheckFiles(const LiveInputs& inputs) {
  KindOfSource(inputs.view.input);
  if (!inputs.view.camera.empty()) ReadCamera(inputs.view.camera);
  if (!inputs.tags.empty()) ReadBodyTags(inputs.tags);
}

LiveParts OpenLive(LiveInputs inputs, const PhotoLifter& lifter, SystemCalls* system) {
  LiveParts parts;
  inputs.view.realtime = true;
  inputs.view.keep_encoded = true;
  const bool has_tags = !inputs.tags.empty();
  parts.source = OpenSource(inputs.view, has_tags ? Pictures::kBoth : Pictures::kBgr, system);
  parts.frame_time_s = FrameTime_s(inputs.view, *parts.source);
  const Eigen::Quaterniond cam_from_world = CamFromWorld(inputs.view);
  parts.up_in_cam = cam_from_world * Eigen::Vector3d::UnitY();
  if (!has_tags) return parts;
  TagSessionOptions options;
  options.search.threads = 2;
  options.cam_from_world = cam_from_world;
  options.tracker.depth_sigma = DepthSigma(inputs.view);
  parts.tags = std::make_unique<TagSession>(ReadBodyTags(inputs.tags),
                                            CameraOf(inputs.view, parts.source->size_px()), lifter,
                                            ReadModels(inputs.view).codebook, options);
  return parts;
}

}  // namespace poselift
