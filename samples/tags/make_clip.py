# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the poselift authors
"""Make the sample clip: the clothed person of samples/photo in printed tags, walking and waving.

It reads SHEETS, what `poselift tags print --set body --out SHEETS/tags.svg` writes: the papers are
painted as they are printed and worn where the sheets say. Into OUTDIR it writes
  room.png              the room without him
  frames/0001.png ...   the columns of each picture that he may be in
  truth.json            for each picture the joints in the camera's frame and the tags it shows
  camera.yaml           the camera, as OpenCV FileStorage YAML
  tags.toml             what the person wears, as printed
  tags.true.toml        the same with the joints where they truly are, seen from the tags

Command (samples/tags/README.md has the whole of it):
  blender --background --python samples/tags/make_clip.py -- SHEETS OUTDIR [FIRST LAST]
FIRST and LAST: only these pictures; 0 0 renders none.
Packages (Debian 12): blender (3.4.1), morse-simulator-data (the person, BSD-3).
"""

import json
import math
import os
import re
import shutil
import sys

import bpy
from bpy_extras.object_utils import world_to_camera_view
from mathutils import Matrix, Vector

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "photo"))
import make_sample as studio  # noqa: E402

FPS = 30
SECONDS = 3.0
EXPOSURE_S = 1 / 120
SIZE = (1280, 720)
CAMERA = {"azimuth": 0, "elevation": 0, "roll": 0, "distance": 2.6, "focal_px": 914.0,
          "target": (0.0, 0.0, 0.95)}
# Only these columns change: the rest is one picture of the empty room.
COLUMNS = (380, 900)
SAMPLES = 9
CELLS = 10  # of a paper's edge: 8 of the tag and the white border
MOST_BENT_M = 0.015  # cloth that lies farther below a paper's middle does not tilt it
MOST_PIERCED_M = 0.025  # cloth that bulges more is let through
MOST_SLOPE = 0.45  # more is a hem
GAP_M = 0.004  # between the paper and what stands out most below it
SEEN_DEG = 70  # tags that are turned away further are not listed


# ---- the motion: degrees and directions at moments, with smooth curves between ----

STRIDE_S = 1.16
# A stride in tenths, from a heel's strike to the next of the same foot; forward is positive.
HIP = (28, 24, 17, 8, -1, -8, -5, 12, 27, 32)
KNEE = (6, 16, 18, 13, 9, 15, 38, 60, 50, 22)
ANKLE = (0, -5, 3, 7, 9, 5, -14, -8, 0, 2)
SHOULDER = (-17, -14, -6, 3, 11, 15, 12, 5, -5, -14)
ELBOW = (16, 18, 22, 28, 34, 36, 32, 26, 20, 16)

# The right arm as it waves: seconds, degrees of the upper arm forward, outward and of the elbow.
WAVE = ((1.35, None), (1.85, (84, -18, 60)), (2.13, (80, -20, 112)), (2.41, (86, -22, 52)),
        (2.69, (80, -20, 112)), (2.97, (86, -22, 52)), (3.2, (80, -20, 100)))
# He turns from his right to his left: first his left side is seen, then his right.
TURN = ((0.0, -42), (0.25, -40), (1.75, 46), (3.2, 43))


def hermite(a, b, slope_a, slope_b, s):
    return ((1 + 2 * s) * (1 - s) ** 2 * a + s * (1 - s) ** 2 * slope_a
            + s * s * (3 - 2 * s) * b + s * s * (s - 1) * slope_b)


def cyclic(values, phase):
    """A smooth curve through values at even phases of a cycle of 1."""
    n = len(values)
    at = phase % 1.0 * n
    i = int(at)
    p, a, b, q = (values[(i + k) % n] for k in (-1, 0, 1, 2))
    return hermite(a, b, (b - p) / 2, (q - a) / 2, at - i)


def eased(keys, time_s):
    """From key to key, at rest at each."""
    if time_s <= keys[0][0]:
        return keys[0][1]
    for (t0, a), (t1, b) in zip(keys, keys[1:]):
        if time_s < t1:
            return hermite(a, b, 0, 0, (time_s - t0) / (t1 - t0))
    return keys[-1][1]


def swing(phase):
    """Degrees forward, outward and of the elbow of an arm beside a leg at this phase."""
    return cyclic(SHOULDER, phase), 9, cyclic(ELBOW, phase)


def right_arm(time_s, phase):
    keys = [(t, value or swing(phase)) for t, value in WAVE]
    return [eased([(t, value[i]) for t, value in keys], time_s) for i in range(3)]


def direction(forward_deg, left):
    a = math.radians(forward_deg)
    return Vector((math.sin(a), left, -math.cos(a)))


def pose_at(time_s):
    """The pose of make_sample's Person; the height of the pelvis is set later."""
    turn = eased(TURN, time_s)
    about_up = studio.about("Z", turn)
    wave = 2 * math.pi * time_s / STRIDE_S
    pose = {"pelvis": {"at": (0, 0.012 * math.sin(wave + 2.2), 0.9),
                       "turn": (2.5 * math.sin(wave + 0.9), 3, turn + 5 * math.cos(wave))},
            "chest": (-1.5 * math.sin(wave + 0.9), 4 + math.cos(2 * wave),
                      turn - 6 * math.cos(wave)),
            "head": (0, 3 + 1.5 * math.cos(2 * wave + 0.5), 0.6 * turn)}
    for side, sign, phase in (("R", -1, time_s / STRIDE_S), ("L", 1, time_s / STRIDE_S + 0.5)):
        hip, knee, ankle = (cyclic(curve, phase) for curve in (HIP, KNEE, ANKLE))
        pose["leg_" + side] = {"thigh": about_up @ direction(hip, -0.03 * sign),
                               "shin": about_up @ direction(hip - knee, -0.03 * sign),
                               "turn": (0, knee - hip - ankle, turn + 7 * sign)}
        forward, outward, elbow = swing(phase) if side == "L" else right_arm(time_s, phase)
        left = sign * math.sin(math.radians(outward))
        lift = max(0.0, forward - 40) / 90
        pose["arm_" + side] = {"clavicle": (14 * lift, 6 * lift),
                               "upper": about_up @ direction(forward, left),
                               "fore": about_up @ direction(forward + elbow, 0.5 * left),
                               "hand": 0, "curl": 16}
    return pose


def stand(person, pose):
    """With the lower of both shoes on the floor."""
    person.pose(pose)
    lowest = min(person.rig.pose.bones["foot_" + side].head.z
                 + min((person.turn["foot_" + side] @ (p - person.head("foot_" + side))).z
                       for p in person.shoe(side)) for side in "LR")
    x, y, z = pose["pelvis"]["at"]
    pose["pelvis"]["at"] = (x, y, z + person.sole - lowest)
    person.pose(pose)


class Animation:
    """Each frame's pose as keys of all bones."""

    def __init__(self, person):
        self.person = person
        self.keys = {bone.name: [] for bone in person.rig.pose.bones}

    def add(self):
        for bone in self.person.rig.pose.bones:
            at, turn, _ = bone.matrix_basis.decompose()
            if self.keys[bone.name] and turn.dot(self.keys[bone.name][-1][1]) < 0:
                turn = -turn
            self.keys[bone.name].append((at.copy(), turn))

    def write(self):
        rig = self.person.rig
        rig.animation_data_create().action = action = bpy.data.actions.new("clip")
        for name, keys in self.keys.items():
            rig.pose.bones[name].rotation_mode = "QUATERNION"
            for what, index, count in (("location", 0, 3), ("rotation_quaternion", 1, 4)):
                for axis in range(count):
                    curve = action.fcurves.new('pose.bones["%s"].%s' % (name, what), index=axis)
                    curve.keyframe_points.add(len(keys))
                    curve.keyframe_points.foreach_set(
                        "co", [c for i, key in enumerate(keys)
                               for c in (i + 1, key[index][axis])])
                    for point in curve.keyframe_points:
                        point.interpolation = "LINEAR"
                    curve.update()


# ---- the tags ----

def read_sheets(folder):
    """Of each printed tag, in order, the rows of cells that are black, border included."""
    pages = sorted(f for f in os.listdir(folder) if re.fullmatch(r"tags-\d+\.svg", f))
    tags = []
    for page in pages:
        with open(os.path.join(folder, page)) as f:
            text = f.read()
        for path in re.findall(r'fill:rgb\(0%,0%,0%\);fill-opacity:1;" d="([^"]*Z[^"]*Z[^"]*)"', text):
            boxes = []
            for part in path.split("Z"):
                numbers = [float(n) for n in re.findall(r"-?[\d.]+", part)]
                if len(numbers) >= 8:
                    boxes.append((min(numbers[0::2]), min(numbers[1::2]),
                                  max(numbers[0::2]), max(numbers[1::2])))
            left, top = boxes[0][:2]
            cell = (boxes[0][2] - left) / (CELLS - 2)
            if cell < 5:  # the picture beside the ruler
                continue
            tags.append([[any(x0 < left + (i - 0.5) * cell < x1 and y0 < top + (j - 0.5) * cell < y1
                              for x0, y0, x1, y1 in boxes) for i in range(CELLS)]
                         for j in range(CELLS)])
    return tags


def read_toml(path):
    """The tags of a tags.toml as `tags print` writes it: dictionaries of texts."""
    tags = []
    with open(path) as f:
        for line in f:
            if line.strip() == "[[tag]]":
                tags.append({})
            elif "=" in line and tags:
                key, value = line.split("=", 1)
                tags[-1][key.strip()] = value.strip().strip('"')
    return tags


def paper_material(name, black):
    image = bpy.data.images.new(name, CELLS, CELLS)
    image.pixels = [c for j in reversed(range(CELLS)) for i in range(CELLS)
                    for c in ([0.0, 0.0, 0.0, 1.0] if black[j][i] else [1.0, 1.0, 1.0, 1.0])]
    image.pack()
    material, nodes, links = studio.new_material(name)
    shader = nodes["Principled BSDF"]
    shader.inputs["Roughness"].default_value = 0.8
    shader.inputs["Specular"].default_value = 0.2
    print_, ink = nodes.new("ShaderNodeTexImage"), nodes.new("ShaderNodeMixRGB")
    print_.image, print_.interpolation = image, "Closest"
    ink.inputs["Color1"].default_value = (0.015, 0.015, 0.016, 1)
    ink.inputs["Color2"].default_value = (0.74, 0.74, 0.72, 1)
    links.new(print_.outputs["Color"], ink.inputs["Fac"])
    links.new(ink.outputs["Color"], shader.inputs["Base Color"])
    return material


# Where a tag sits: the bone; the joint it hangs by; up, as a direction or as another joint;
# metres up from the joint; which way it faces. All at rest, when the arms hang down and out and
# the palms look down: x front, y left, z up.
FRONT, BACK, UP, OUTER = (1, 0, 0), (-1, 0, 0), (0, 0, 1), (0.35, 0, 1)
SITES = {
    "pelvis": ("root", "pelvis", UP, 0.0, FRONT),
    "chest": ("spine01", "neck", UP, -0.11, FRONT),
    "back": ("spine01", "neck", UP, -0.09, BACK),
    "head": ("head", "head_top", UP, -0.09, FRONT),
}
for _a, _S in (("left_", "L"), ("right_", "R")):
    SITES.update({
        _a + "upper_arm": ("shoulder02_" + _S, _a + "elbow", _a + "shoulder", 0.16, OUTER),
        _a + "forearm": ("lowerarm02_" + _S, _a + "wrist", _a + "elbow", 0.06, UP),
        _a + "hand": ("wrist_" + _S, _a + "hand", _a + "wrist", 0.03, UP),
        _a + "thigh": ("upperleg01_" + _S, _a + "knee", _a + "hip", 0.19, FRONT),
        _a + "shin": ("lowerleg01_" + _S, _a + "ankle", _a + "knee", 0.19, FRONT),
        _a + "foot": ("foot_" + _S, _a + "foot", BACK, 0.0, UP),
    })


class Tag:
    """A flat paper on the clothes, fixed to a bone."""

    def __init__(self, person, row, black):
        self.name, self.id = row["name"], int(row["id"])
        self.size = 1e-3 * float(row["size_mm"])
        self.bone, self.joint, up, height, facing = SITES[self.name]
        joints = person.joints()
        up = (joints[up] - joints[self.joint] if up in joints else Vector(up)).normalized()
        at, down, out = joints[self.joint] + up * height, -up, Vector(facing)
        self.half_paper = self.size * CELLS / (CELLS - 2) / 2
        turn = self.lay(at, down, out)
        self.joint_in_tag = turn.inverted() @ joints[self.joint]
        self.object = self.paper(person, black, turn)

    def lay(self, at, down, out):
        """world_from_tag (y down the print, z into it) over the surface, found by rays."""
        out = (out - down * out.dot(down)).normalized()
        right = down.cross(-out)
        steps = [k / 4 * self.half_paper for k in range(-4, 5)]
        heights = {}
        for u in steps:
            for v in steps:
                start = at + right * u + down * v + out * 0.35
                hit, place, *_ = bpy.context.scene.ray_cast(
                    bpy.context.evaluated_depsgraph_get(), start, -out, distance=0.45)
                if hit:
                    heights[u, v] = (place - at).dot(out)
        assert (0, 0) in heights, self.name
        near = [(u, v, h) for (u, v), h in heights.items() if abs(h - heights[0, 0]) < MOST_BENT_M]
        # It leans as the surface does along the middle of its print.
        middle = [(v, h) for u, v, h in near if u == 0 and abs(v) < 0.6 * self.half_paper]
        slope = sum(v * h for v, h in middle) / sum(v * v for v, h in middle)
        slope = max(-MOST_SLOPE, min(MOST_SLOPE, slope))
        lift = max(h - v * slope for u, v, h in near) + GAP_M
        y = (down + out * slope).normalized()
        turn = Matrix((right, y, right.cross(y))).transposed().to_4x4()
        return Matrix.Translation(at + out * lift) @ turn

    def paper(self, person, black, turn):
        bpy.ops.mesh.primitive_plane_add(size=2 * self.half_paper)
        paper = bpy.context.object
        paper.name = "tag_" + self.name
        paper.data.materials.append(paper_material(paper.name, black))
        paper.parent, paper.parent_type, paper.parent_bone = person.rig, "BONE", self.bone
        bpy.context.view_layer.update()
        paper.matrix_world = turn @ Matrix.Diagonal((1, -1, -1, 1))  # y up, z out of the paper
        bpy.context.view_layer.update()
        return paper

    def pierced_m(self):
        """How far cloth comes through the paper in the pose that is set."""
        place, most = self.object.matrix_world, 0.0
        out = place.to_3x3().col[2].normalized()
        steps = [k / 4 * self.half_paper for k in range(-4, 5)]
        for at in (place @ Vector((u, v, 0)) for u in steps for v in steps):
            hit, near, *_ = bpy.context.scene.ray_cast(
                bpy.context.evaluated_depsgraph_get(), at + out * MOST_PIERCED_M, -out,
                distance=MOST_PIERCED_M - 0.0005)
            if hit:
                most = max(most, (near - at).dot(out))
        return most

    def move_out(self, by_m):
        place = self.object.matrix_world.copy()
        place.translation += place.to_3x3().col[2].normalized() * by_m
        self.object.matrix_world = place
        self.joint_in_tag.z += by_m
        bpy.context.view_layer.update()

    def seen(self, camera):
        """Its corners in the picture (those of the print: top left, then clockwise), or None."""
        place = self.object.matrix_world
        out = place.to_3x3().col[2].normalized()
        middle = place.translation
        if out.dot((camera.at - middle).normalized()) < math.cos(math.radians(SEEN_DEG)):
            return None
        half = self.half_paper * (CELLS - 2) / CELLS
        corners = [place @ Vector((x * half, y * half, 0))
                   for x, y in ((-1, 1), (1, 1), (1, -1), (-1, -1))]
        pixels = [camera.blender_pixel(corner) for corner in corners]
        graph = bpy.context.evaluated_depsgraph_get()
        for point, (x, y) in zip(corners + [middle], pixels + pixels[:1]):
            inside = -0.5 <= x < camera.width - 0.5 and -0.5 <= y < camera.height - 0.5
            ray = point - camera.at
            hit, near, *_ = bpy.context.scene.ray_cast(graph, camera.at, ray.normalized(),
                                                       distance=ray.length - 0.003)
            if hit or not inside:
                return None
        return [[round(c, 2) for c in pixel] for pixel in pixels]


def true_toml(lines, tags):
    """tags.toml with the joints where they truly are."""
    by_id = {tag.id: tag for tag in tags}
    text, tag = "", None
    for line in lines:
        if line.startswith("id ="):
            tag = by_id[int(line.split("=")[1])]
        if line.startswith("joint_in_tag_mm"):
            line = "joint_in_tag_mm = [%s]\n" % ", ".join(
                "%.1f" % (1e3 * c) for c in tag.joint_in_tag)
        if line.startswith("joint_sigma_mm"):
            line = "joint_sigma_mm = 3\n"
        if not line.startswith("faces"):
            text += line
    return text


# ---- the pictures ----

def room():
    studio.plane(studio.tile_material("floor", (0.42, 0.27, 0.15), (0.34, 0.20, 0.11),
                                      (0.16, 0.09, 0.05), 1.4, 0.16, gap=0.003),
                 (14, 14), (0, 0, 0), (0, 0, 90))
    studio.wall(studio.plain_material("wall", (0.50, 0.54, 0.53)), 0, 2.6, 14, 3.2)
    studio.wall(studio.plain_material("skirting", (0.75, 0.75, 0.73)), 0, 2.58, 14, 0.12)
    studio.area_light((3.6, -0.9, 2.8), 0.8, 190, (1, 0.96, 0.90))
    studio.area_light((3.2, 1.1, 2.3), 0.8, 80, (0.92, 0.96, 1))
    studio.ambient((0.9, 0.95, 1.0), 0.4)


def prepare_render():
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = SAMPLES
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.use_denoising = False
    scene.cycles.seed = 0
    scene.cycles.max_bounces = 0
    scene.cycles.transparent_max_bounces = 4
    scene.cycles.sample_clamp_direct = 3
    scene.render.use_persistent_data = True
    scene.render.use_motion_blur = True
    scene.render.motion_blur_shutter = EXPOSURE_S * FPS
    scene.cycles.motion_blur_position = "CENTER"
    scene.render.fps = FPS
    scene.view_settings.view_transform = "Standard"
    scene.render.resolution_x, scene.render.resolution_y = SIZE
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "PNG"
    scene.render.use_file_extension = False


def render(path):
    bpy.context.scene.render.filepath = path
    bpy.ops.render.render(write_still=True)


def render_room(person, tags, path):
    him = person.meshes + [tag.object for tag in tags]
    for part in him:
        part.hide_render = True
    render(path)
    for part in him:
        part.hide_render = False


def write_truth(path, frames):
    head = {"units": "m", "axes": "x right, y down, z forward", "frame": "cam", "fps": FPS}
    with open(path, "w") as f:
        f.write(json.dumps(head)[:-1] + ', "frames": [\n')
        f.write(",\n".join(json.dumps(frame) for frame in frames) + "\n]}\n")


def main():
    args = sys.argv[sys.argv.index("--") + 1:]
    sheets, outdir = (os.path.abspath(a) for a in args[:2])
    num_frames = round(SECONDS * FPS)
    first, last = (int(a) for a in args[2:4]) if len(args) > 2 else (1, num_frames)
    os.makedirs(os.path.join(outdir, "frames"), exist_ok=True)

    bpy.ops.wm.open_mainfile(filepath=studio.MODEL)
    studio.remove_the_rest()
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 1, num_frames
    prepare_render()
    person = studio.Person()
    bpy.context.view_layer.update()
    printed = os.path.join(sheets, "tags.toml")
    tags = [Tag(person, row, black)
            for row, black in zip(read_toml(printed), read_sheets(sheets), strict=True)]
    camera = studio.Camera(SIZE, CAMERA)

    animation = Animation(person)
    for i in range(num_frames + 1):
        stand(person, pose_at(i / FPS))
        animation.add()
    animation.write()

    pierced = {tag: 0.0 for tag in tags}
    for i in range(1, num_frames, 4):
        scene.frame_set(i)
        pierced = {tag: max(most, tag.pierced_m()) for tag, most in pierced.items()}
    for tag, most in pierced.items():
        tag.move_out(most + GAP_M / 2 if most > 0 else 0)
        print("%s moved out by %.1f mm" % (tag.name, 1e3 * most))

    frames = []
    for i in range(num_frames):
        scene.frame_set(i + 1)
        joints = person.joints()
        seen = {tag.id: tag.seen(camera) for tag in tags}
        frames.append({
            "time_s": round(i / FPS, 4),
            "joints_in_cam": {name: [round(c, 4) for c in camera.to_cam(at)]
                              for name, at in sorted(joints.items())},
            "tags": {str(id_): corners for id_, corners in seen.items() if corners}})
    write_truth(os.path.join(outdir, "truth.json"), frames)
    with open(os.path.join(outdir, "camera.yaml"), "w") as f:
        f.write(camera.yaml())
    shutil.copy(printed, os.path.join(outdir, "tags.toml"))
    with open(printed) as f, open(os.path.join(outdir, "tags.true.toml"), "w") as g:
        g.write(true_toml(f.readlines(), tags))

    room()
    if first == 1:
        render_room(person, tags, os.path.join(outdir, "room.png"))
    scene.render.use_border = scene.render.use_crop_to_border = True
    scene.render.border_min_x, scene.render.border_max_x = (c / SIZE[0] for c in COLUMNS)
    for i in range(max(1, first), last + 1):
        scene.frame_set(i)
        scene.cycles.seed = i
        render(os.path.join(outdir, "frames", "%04d.png" % i))


if __name__ == "__main__":
    main()
