// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Real: mouse events on the 3D view of the sample picture and of a pose without a picture, the
// dictionary that ships, the files that are exported. Checked: a joint goes where the mouse drags
// it, and what was dragged can be undone and exported.
#include "ui/window/pose_canvas.h"

#include <QSignalSpy>

#include "lift/normalize.h"
#include "src/forward_kinematics.h"
#include "src/io/motion_file.h"
#include "tests/support/run_program.h"
#include "tests/ui/window/sample_window.h"
#include "ui/label/new_pose.h"

namespace poselift {
namespace {

namespace fs = std::filesystem;

class PoseCanvasTest : public testing::SampleWindow {
 protected:
  void OpenNewPose() {
    window_.reset();
    project_.reset();
    file_ = folder_ / "hero.labels.json";
    for (const char* left : {"hero.labels.json", ".hero.labels.json.journal"})
      fs::remove(folder_ / left);
    CreatePoseFile(file_, "body15", dictionary_.skeleton);
    project_ = std::make_unique<LabelProject>(file_);
    window_ = std::make_unique<MainWindow>(project_.get(), lifter_, KeyMap());
    window_->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(window_.get()));
    picture_ = window_->findChild<PictureCanvas*>("picture");
    Solve();
  }
  void Solve() {
    window_->session().WaitUntilSolved();
    window_->Refresh();
    ASSERT_NE(window_->session().pose(), nullptr);
  }
  PoseCanvas* Canvas() const { return window_->findChild<PoseCanvas*>("pose"); }
  size_t Handle(std::string_view name) const {
    const auto& handles = window_->session().handles();
    return static_cast<size_t>(std::ranges::find(handles, name, &PoseHandle::name) -
                               handles.begin());
  }
  QPoint At(std::string_view name) const { return Canvas()->HandleAt(Handle(name))->toPoint(); }
  Eigen::Vector3d Place_m(std::string_view name) const {
    return window_->session().handles()[Handle(name)].In(
        window_->session().pose()->joints_in_cam_m);
  }
  void Drag(std::string_view name, QPoint by, Qt::KeyboardModifiers keys = {}) {
    const QPoint from = At(name);
    QTest::mouseMove(Canvas(), from);
    QTest::mousePress(Canvas(), Qt::LeftButton, keys, from);
    for (const double part : {0.4, 0.8, 1.0})
      QTest::mouseMove(Canvas(), from + (part * QPointF(by)).toPoint());
    Solve();
    held_ = At(name);
    QTest::mouseRelease(Canvas(), Qt::LeftButton, keys, from + by);
    Solve();
  }

  QPoint held_;  // where the last joint was when it was let go
};

TEST_F(PoseCanvasTest, AWristOfTheSampleIsDraggedAndUndone) {
  ClickAll();
  Solve();
  const Eigen::Vector3d before_m = Place_m("left_wrist");
  QTest::mouseDClick(Canvas(), Qt::LeftButton, {}, {20, 20});
  // From the side: to where no label says how deep it is.
  QTest::mousePress(Canvas(), Qt::LeftButton, {}, {20, 20});
  QTest::mouseMove(Canvas(), {190, 20});
  QTest::mouseRelease(Canvas(), Qt::LeftButton, {}, {190, 20});
  const QPoint from = At("left_wrist");
  Drag("left_wrist", {30, 0});
  EXPECT_GT(held_.x(), from.x() + 8);
  EXPECT_EQ(window_->session().Hints().size(), 1U);
  EXPECT_GT((Place_m("left_wrist") - before_m).norm(), 0.03);
  QTest::keyClick(window_.get(), Qt::Key_Z, Qt::ControlModifier);
  Solve();
  EXPECT_TRUE(testing::MatrixNear(Place_m("left_wrist"), before_m, 1e-6));
  EXPECT_TRUE(window_->session().Hints().empty());
}

TEST_F(PoseCanvasTest, ThePlaceUnderTheMouseIsSaidAndAPressBesideTurns) {
  OpenNewPose();
  auto* const status = window_->findChild<QWidget*>("status");
  testing::HoverOver(Canvas(), At("left_elbow"));
  EXPECT_EQ(window_->session().hovered(), Handle("left_elbow"));
  EXPECT_TRUE(status->property("text").toString().contains("left elbow"));
  const double yaw_rad = Canvas()->orbit().yaw_rad;
  testing::HoverOver(Canvas(), {10, 10});
  EXPECT_FALSE(window_->session().hovered());
  QTest::mousePress(Canvas(), Qt::LeftButton, {}, {10, 10});
  QTest::mouseMove(Canvas(), {60, 10});
  QTest::mouseRelease(Canvas(), Qt::LeftButton, {}, {60, 10});
  EXPECT_NE(Canvas()->orbit().yaw_rad, yaw_rad);
  EXPECT_FALSE(project_->history().CanUndo());
}

TEST_F(PoseCanvasTest, TheRightButtonPinsAndLetsGo) {
  OpenNewPose();
  auto* const hints = window_->findChild<QListWidget*>("hints");
  const auto num_shown = [&] {
    int count = 0;
    for (int row = 0; row < hints->count(); ++row) count += hints->item(row)->isHidden() ? 0 : 1;
    return count;
  };
  EXPECT_EQ(num_shown(), 0);
  const QImage before = Canvas()->grab().toImage();
  QTest::mouseClick(Canvas(), Qt::RightButton, {}, At("right_ankle"));
  Solve();
  EXPECT_TRUE(window_->session().PinnedAt(Handle("right_ankle")));
  EXPECT_EQ(num_shown(), 1);
  EXPECT_NE(Canvas()->grab().toImage(), before);
  QTest::mouseClick(Canvas(), Qt::RightButton, {}, At("right_ankle"));
  EXPECT_FALSE(window_->session().PinnedAt(Handle("right_ankle")));
}

TEST_F(PoseCanvasTest, APoseIsMadeFromNothingAndExported) {
  OpenNewPose();
  const Eigen::Vector3d ankle_m = Place_m("right_ankle");
  const QPoint wrist = At("left_wrist");
  Drag("left_wrist", {30, -60});
  EXPECT_LT((held_ - wrist - QPoint(30, -60)).manhattanLength(), 12);
  EXPECT_LT((Place_m("right_ankle") - ankle_m).norm(), 0.03);
  Drag("right_wrist", {-20, -40}, Qt::ShiftModifier);
  window_->findChild<QAction*>("add_key_frame")->trigger();
  Solve();
  Drag("left_knee", {0, -30});
  EXPECT_EQ(window_->session().frame_index(), 1U);
  const Eigen::Vector3d knee_m = Place_m("left_knee");
  QTest::keyClick(window_.get(), Qt::Key_S, Qt::ControlModifier);
  window_->ExportTo(QString::fromStdString((folder_ / "hero").string()));
  window_->session().WaitUntilExported();
  const Motion motion = ReadMotion(folder_ / "hero/poses.bvh");
  ASSERT_EQ(motion.frames.size(), 16U);  // half a second
  const Pose3 joints_m = JointPositions(motion.skeleton, motion.frames.back());
  const Eigen::Vector3d in_file_m = joints_m.col(joint::kLeftKnee) - joints_m.col(joint::kPelvis);
  EXPECT_LT((in_file_m.cwiseProduct(Eigen::Vector3d(1, -1, -1)) - knee_m).norm(), 0.01);
  const auto run = testing::RunProgram("lift --labels " + file_.string() + " --out " +
                                       (folder_ / "program").string());
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(ReadMotion(folder_ / "program/poses.bvh").frames.size(), 16U);
}

}  // namespace
}  // namespace poselift
