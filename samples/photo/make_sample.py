# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the poselift authors
"""Make the sample pictures: a clothed, rigged person posed and rendered by Blender.

For each picture NAME it writes into OUTDIR
  NAME.jpg          the picture
  NAME.exact.json   exact 2D labels of the rig's joints (layout body15)
  NAME.truth.json   the joints in the camera's frame, in metres
  NAME.camera.yaml  the camera, as OpenCV FileStorage YAML
(NAME.labels.json, placed by eye, is not made here.)

Command (add picture names after OUTDIR to make only those):
  blender --background --python samples/photo/make_sample.py -- OUTDIR
Packages (Debian 12): blender (3.4.1), morse-simulator-data (the person, BSD-3).
"""

import json
import math
import os
import sys

import bmesh
import bpy
from bpy_extras.object_utils import world_to_camera_view
from mathutils import Euler, Matrix, Vector

MODEL = "/usr/share/morse/data/robots/human_rig.blend"
ARMATURE = "HumanSkeleton"
MESH_PREFIX = "MakeHuman skeleton_man1-"
BODY_HEIGHT_M = 1.75  # sole of the shoe to crown
SAMPLES = 160
MAX_DISAGREEMENT_PX = 0.05

# A joint lies inside the body, so the first surface a ray meets is a little
# in front of it even when nothing hides it; the trunk is thicker than a limb.
LIMB_DEPTH_M = 0.15
TRUNK_DEPTH_M = 0.225
TRUNK_JOINTS = ("pelvis", "neck", "left_hip", "right_hip")

TEXTURES = {
    "male1591": "young_lightskinned_male_diffuse.png",
    "eyes": "brown_eye.png",
    "mhair02": "male02_diffuse_black.png",
    "tshirt02": "tshirt02_texture.png",
    "jeans01": "jeans_basic_diffuse.png",
    "classic_shoes_lres": "classicshoes_texture_diffuse.png",
}

# The bone whose head is the joint. The neck and the crown are no bone heads:
# see rest_points().
JOINT_BONES = {
    "pelvis": "spine04",
    "left_shoulder": "shoulder02_L",
    "right_shoulder": "shoulder02_R",
    "left_elbow": "lowerarm01_L",
    "right_elbow": "lowerarm01_R",
    "left_wrist": "wrist_L",
    "right_wrist": "wrist_R",
    "left_hip": "upperleg01_L",
    "right_hip": "upperleg01_R",
    "left_knee": "lowerleg01_L",
    "right_knee": "lowerleg01_R",
    "left_ankle": "foot_L",
    "right_ankle": "foot_R",
    "left_hand": "finger3-1_L",
    "right_hand": "finger3-1_R",
}
BODY15 = (
    "pelvis neck head_top left_shoulder right_shoulder left_elbow right_elbow "
    "left_wrist right_wrist left_hip right_hip left_knee right_knee "
    "left_ankle right_ankle").split()

# Poses. The person stands at the origin, faces +x, his left is +y, z is up;
# lengths are in the rig's metres above the floor. Turns are (lean sideways,
# lean forward, turn left) in degrees. Arm: clavicle (up, forward) in degrees,
# directions of upper arm and forearm, turn of the hand about the forearm,
# curl of the fingers. Leg: either "foot" (ankle's place on the floor, with the
# turn and heel lift of the shoe and where the knee points) or the directions
# of thigh and shin and the shoe's turn.
PICTURES = {
    "reach": {
        "size": (800, 600),
        "camera": {"azimuth": 105, "elevation": 0, "roll": 0, "distance": 4.1,
                   "focal_px": 1150, "target": (-0.02, -0.05, 0.86)},
        "scene": "room",
        "pose": {
            "pelvis": {"at": (-0.02, 0.0, 0.78), "turn": (0, 6, 6)},
            "chest": (0, 12, 10),
            "head": (0, 6, 0),
            "arm_L": {"clavicle": (0, -8), "upper": (-0.75, 0.35, -0.55),
                      "fore": (-0.80, 0.30, -0.25), "hand": 0, "curl": 12},
            "arm_R": {"clavicle": (10, 18), "upper": (0.90, -0.25, 0.10),
                      "fore": (0.93, -0.02, 0.30), "hand": 0, "curl": 6},
            "leg_L": {"foot": (-0.48, 0.12), "turn": 4, "heel": 35, "knee": (1, 0.1, 0)},
            "leg_R": {"foot": (0.34, -0.13), "turn": -4, "heel": 0, "knee": (1, -0.1, 0)},
        },
    },
    "throw": {
        "size": (800, 600),
        "camera": {"azimuth": 45, "elevation": 30, "roll": 12, "distance": 4.4,
                   "focal_px": 1150, "target": (0.0, 0.0, 0.85)},
        "scene": "court",
        "pose": {
            "pelvis": {"at": (-0.02, 0.0, 0.80), "turn": (0, -4, -50)},
            "chest": (4, -12, -68),
            "head": (0, 0, -8),
            "arm_L": {"clavicle": (5, 10), "upper": (0.90, 0.25, 0.10),
                      "fore": (0.90, -0.15, 0.35), "hand": 0, "curl": 8},
            "arm_R": {"clavicle": (18, -12), "upper": (-0.80, -0.50, 0.25),
                      "fore": (-0.15, -0.35, 0.95), "hand": 0, "curl": 35},
            "leg_L": {"foot": (0.48, 0.10), "turn": -10, "heel": 0, "knee": (1, 0, 0)},
            "leg_R": {"foot": (-0.36, -0.10), "turn": -70, "heel": 0, "knee": (0.4, -1, 0)},
        },
    },
    "kick": {
        "size": (720, 640),
        "camera": {"azimuth": 65, "elevation": 10, "roll": -4, "distance": 4.6,
                   "focal_px": 1200, "target": (0.15, 0.0, 0.85)},
        "scene": "yard",
        "pose": {
            "pelvis": {"at": (-0.05, 0.02, 0.86), "turn": (0, -14, 12)},
            "chest": (0, -5, 18),
            "head": (0, 6, 5),
            "arm_L": {"clavicle": (0, 15), "upper": (0.60, 0.15, -0.78),
                      "fore": (0.55, -0.75, 0.45), "hand": 0, "curl": 25},
            "arm_R": {"clavicle": (0, 15), "upper": (0.35, -0.15, -0.92),
                      "fore": (0.45, 0.85, 0.20), "hand": 0, "curl": 25},
            "leg_L": {"foot": (-0.03, 0.05), "turn": 25, "heel": 0, "knee": (1, 0.4, 0)},
            "leg_R": {"thigh": (0.93, -0.05, 0.25), "shin": (0.95, -0.05, -0.12),
                      "turn": (0, -75, 0)},
        },
    },
}


# ---- small geometry ----

def turn_matrix(degrees):
    return Euler([math.radians(a) for a in degrees], "XYZ").to_matrix()


def about(axis, degrees):
    return Matrix.Rotation(math.radians(degrees), 3, axis)


def blend(a, b, t):
    return a.to_quaternion().slerp(b.to_quaternion(), t).to_matrix()


def frame(along, hinge):
    x = along.normalized()
    z = x.cross(hinge).normalized()
    return Matrix((x, z.cross(x), z)).transposed()


def carry(rest_along, rest_hinge, along, hinge):
    return frame(along, hinge) @ frame(rest_along, rest_hinge).transposed()


def two_bones(root, end, length1, length2, bend_towards):
    """Directions of two bones that lead from root to end."""
    span = end - root
    d = span.length
    assert d < length1 + length2, "the leg is too short for this step: %.3f" % d
    cosine = (length1 ** 2 + d * d - length2 ** 2) / (2 * length1 * d)
    axis = span.normalized()
    side = (bend_towards - axis * bend_towards.dot(axis)).normalized()
    middle = root + axis * length1 * cosine + side * length1 * math.sqrt(1 - cosine ** 2)
    return middle - root, end - middle


def drop(obj, covered):
    """Delete the vertices of a mesh whose rest places satisfy the test."""
    work = bmesh.new()
    work.from_mesh(obj.data)
    bmesh.ops.delete(work, geom=[v for v in work.verts if covered(v.co)], context="VERTS")
    work.to_mesh(obj.data)
    work.free()


# ---- the person ----

class Person:
    """The rig: one rotation per bone (rest to posed, in the armature's frame)."""

    def __init__(self):
        self.rig = bpy.data.objects[ARMATURE]
        self.meshes = [o for o in bpy.data.objects if o.name.startswith(MESH_PREFIX)]
        self.bones = self.rig.data.bones
        self.turn = {}
        self.free_the_rig()
        self.prepare_meshes()
        self.points = self.rest_points()
        self.stand_on_the_floor()

    def free_the_rig(self):
        self.rig.animation_data_clear()
        for bone in self.rig.pose.bones:
            for constraint in list(bone.constraints):
                bone.constraints.remove(constraint)
            bone.matrix_basis.identity()

    def prepare_meshes(self):
        for mesh in self.meshes:
            for modifier in mesh.modifiers:
                # The file leaves the skin to bone envelopes, which tear it
                # in strong poses; its vertex weights do not.
                modifier.use_vertex_groups = True
                modifier.use_bone_envelopes = False
                modifier.use_deform_preserve_volume = True
            if not mesh.name.endswith("eyes"):  # smoothing sinks them into the head
                smooth = mesh.modifiers.new("smooth", "SUBSURF")
                smooth.levels = smooth.render_levels = 1
            texture_material(mesh, TEXTURES[mesh.name[len(MESH_PREFIX):]])

        self.dress()

    def dress(self):
        """Keep skin and trousers from poking through the shirt in strong poses."""
        drop(self.mesh("male1591"), lambda p: 1.0 < p.z < 1.34 and abs(p.y) < 0.19)
        drop(self.mesh("jeans01"), lambda p: p.z > 1.0)
        shirt = self.mesh("tshirt02")
        loosen = shirt.modifiers.new("loosen", "DISPLACE")
        loosen.strength, loosen.mid_level = 0.010, 0

    def mesh(self, name):
        return bpy.data.objects[MESH_PREFIX + name]

    def head(self, bone):
        return self.bones[bone].head_local

    def rest_points(self):
        """Joints that are no bone heads: name -> (bone that carries it, rest place)."""
        skin = [v.co for v in self.mesh("male1591").data.vertices]
        points = {
            "neck": ("spine01", (self.head("clavicle_L") + self.head("clavicle_R")) / 2),
            "head_top": ("head", max(skin, key=lambda p: p.z).copy()),
        }
        for side, name in (("L", "left_foot"), ("R", "right_foot")):
            points[name] = ("foot_" + side, self.toe_base(side))
        return points

    def shoe(self, side):
        sign = 1 if side == "L" else -1
        return [v.co for v in self.mesh("classic_shoes_lres").data.vertices
                if sign * v.co.y > 0]

    def toe_base(self, side):
        """Middle of the shoe 70 % of the way from heel to toe, 3 cm above the sole."""
        shoe = self.shoe(side)
        heel, toe = min(p.x for p in shoe), max(p.x for p in shoe)
        x = heel + 0.70 * (toe - heel)
        ys = [p.y for p in shoe if abs(p.x - x) < 0.02]
        return Vector((x, (min(ys) + max(ys)) / 2, min(p.z for p in shoe) + 0.03))

    def stand_on_the_floor(self):
        self.sole = min(p.z for p in self.shoe("L"))
        crown = self.points["head_top"][1].z
        self.rig.location = (0, 0, -self.sole)
        self.rig.parent.scale = [BODY_HEIGHT_M / (crown - self.sole)] * 3

    def pose(self, pose):
        self.turn = {}
        self.pose_trunk(pose)
        for side in "LR":
            self.pose_arm(side, pose["arm_" + side])
            self.pose_leg(side, pose["leg_" + side])
        self.apply()

    def pose_trunk(self, pose):
        pelvis = turn_matrix(pose["pelvis"]["turn"])
        chest, head = turn_matrix(pose["chest"]), turn_matrix(pose["head"])
        self.turn["root"] = pelvis
        for i, bone in enumerate(("spine04", "spine03", "spine02", "spine01")):
            self.turn[bone] = blend(pelvis, chest, (i + 1) / 4)
        for i, bone in enumerate(("neck01", "neck02", "neck03", "head")):
            self.turn[bone] = blend(chest, head, (i + 1) / 4)
        hips = (self.head("upperleg01_L") + self.head("upperleg01_R")) / 2
        wanted = Vector(pose["pelvis"]["at"]) + Vector((0, 0, self.sole))
        root = self.head("root")
        self.root_at = wanted - pelvis @ (hips - root)

    def pose_arm(self, side, arm):
        sign = 1 if side == "L" else -1
        up, forward = arm["clavicle"]
        self.turn["clavicle_" + side] = (
            self.turn["spine01"] @ about("X", sign * up) @ about("Z", -sign * forward))
        upper, fore = Vector(arm["upper"]), Vector(arm["fore"])
        shoulder, elbow, wrist = (self.head(b + side) for b in ("shoulder02_", "lowerarm01_", "wrist_"))
        hinge, rest_hinge = upper.cross(fore), (elbow - shoulder).cross(wrist - elbow)
        self.turn["shoulder02_" + side] = carry(elbow - shoulder, rest_hinge, upper, hinge)
        lower = carry(wrist - elbow, rest_hinge, fore, hinge)
        for bone, share in (("lowerarm01_", 0.3), ("lowerarm02_", 0.7), ("wrist_", 1.0)):
            self.turn[bone + side] = about(fore, sign * share * arm["hand"]) @ lower
        self.curl_fingers(side, arm["curl"])

    def curl_fingers(self, side, degrees):
        across = self.head("finger2-1_" + side) - self.head("finger5-1_" + side)
        sign = 1 if side == "L" else -1
        for finger in "2345":
            for joint in "123":
                bone = "finger%s-%s_%s" % (finger, joint, side)
                self.turn[bone] = (self.turn["wrist_" + side]
                                   @ about(across, sign * degrees * int(joint)))

    def pose_leg(self, side, leg):
        hip, knee, ankle = (self.head(b + side) for b in ("upperleg01_", "lowerleg01_", "foot_"))
        if "foot" in leg:
            shoe = about("Z", leg["turn"]) @ about("Y", leg["heel"])
            # The shoe is rigid: its lowest point touches the floor.
            height = -min((shoe @ (p - ankle)).z for p in self.shoe(side)) + self.sole
            at = Vector((*leg["foot"], height))
            thigh, shin = two_bones(self.posed("root", hip), at, (knee - hip).length,
                                    (ankle - knee).length, Vector(leg["knee"]))
        else:
            thigh, shin = Vector(leg["thigh"]), Vector(leg["shin"])
            shoe = turn_matrix(leg["turn"])
        hinge = thigh.cross(shin)
        left = self.turn["root"] @ Vector((0, 1, 0))
        assert hinge.dot(left) > 0, "the knee bends backwards"
        rest_left = Vector((0, 1, 0))
        self.turn["upperleg01_" + side] = carry(knee - hip, rest_left, thigh, hinge)
        self.turn["lowerleg01_" + side] = carry(ankle - knee, rest_left, shin, hinge)
        self.turn["foot_" + side] = shoe

    def posed(self, bone, rest_point):
        """Where a point carried by the root goes, before apply()."""
        return self.root_at + self.turn[bone] @ (rest_point - self.head(bone))

    def apply(self):
        posed, turns = {}, {}
        for bone in self.bones:  # parents come first
            parent = bone.parent
            turns[bone] = self.turn.get(bone.name, turns.get(parent))
            at = (self.root_at if parent is None else
                  posed[parent].translation + turns[parent] @ (bone.head_local - parent.head_local))
            rest = bone.matrix_local
            posed[bone] = Matrix.Translation(at) @ (turns[bone] @ rest.to_3x3()).to_4x4()
            basis = {"parent_matrix": posed[parent],
                     "parent_matrix_local": parent.matrix_local} if parent else {}
            self.rig.pose.bones[bone.name].matrix_basis = bone.convert_local_to_pose(
                posed[bone], rest, invert=True, **basis)
        bpy.context.view_layer.update()

    def joints(self):
        """World places of all joints, in metres, read back from Blender."""
        world, posed = self.rig.matrix_world, self.rig.pose.bones
        joints = {name: world @ posed[bone].head for name, bone in JOINT_BONES.items()}
        for name, (bone, rest) in self.points.items():
            move = posed[bone].matrix @ self.bones[bone].matrix_local.inverted()
            joints[name] = world @ (move @ rest)
        return joints


# ---- materials, rooms and light ----

def new_material(name):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    return material, material.node_tree.nodes, material.node_tree.links


def texture_material(mesh, image_name):
    """Cycles ignores the file's old-style materials: build one from the packed image."""
    material, nodes, links = new_material(mesh.name)
    shader = nodes["Principled BSDF"]
    shader.inputs["Roughness"].default_value = 0.75
    shader.inputs["Specular"].default_value = 0.2
    image = nodes.new("ShaderNodeTexImage")
    image.image = bpy.data.images[image_name]
    links.new(image.outputs["Color"], shader.inputs["Base Color"])
    if "hair" in mesh.name:
        links.new(image.outputs["Alpha"], shader.inputs["Alpha"])
    mesh.data.materials.clear()
    mesh.data.materials.append(material)


def tile_material(name, color1, color2, mortar, width, height, offset=0.5, gap=0.006):
    material, nodes, links = new_material(name)
    shader = nodes["Principled BSDF"]
    shader.inputs["Roughness"].default_value = 0.6
    place, tiles = nodes.new("ShaderNodeTexCoord"), nodes.new("ShaderNodeTexBrick")
    tiles.offset = offset
    for key, value in {"Color1": color1 + (1,), "Color2": color2 + (1,), "Mortar": mortar + (1,),
                       "Scale": 1.0, "Mortar Size": gap, "Brick Width": width,
                       "Row Height": height}.items():
        tiles.inputs[key].default_value = value
    links.new(place.outputs["Object"], tiles.inputs["Vector"])
    links.new(tiles.outputs["Color"], shader.inputs["Base Color"])
    return material


def plain_material(name, color):
    material, nodes, _ = new_material(name)
    shader = nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = color + (1,)
    shader.inputs["Roughness"].default_value = 0.9
    return material


def plane(material, size, at, turn=(0, 0, 0)):
    bpy.ops.mesh.primitive_plane_add(size=1, location=at,
                                     rotation=[math.radians(a) for a in turn])
    obj = bpy.context.object
    # Scale the mesh, not the object: the textures are in the object's metres.
    obj.data.transform(Matrix.Diagonal((size[0], size[1], 1, 1)))
    obj.data.materials.append(material)
    return obj


def wall(material, azimuth, distance, width, height):
    """A standing plane opposite a camera at this azimuth."""
    a = math.radians(azimuth)
    return plane(material, (width, height),
                 (-distance * math.cos(a), -distance * math.sin(a), height / 2),
                 (90, 0, azimuth + 90))


def area_light(at, size, watts, color=(1, 1, 1)):
    bpy.ops.object.light_add(type="AREA", location=at)
    light = bpy.context.object
    light.data.size, light.data.energy, light.data.color = size, watts, color
    light.rotation_euler = (Vector((0, 0, 0.9)) - Vector(at)).to_track_quat("-Z", "Y").to_euler()


def sun(turn, strength, angle=4):
    bpy.ops.object.light_add(type="SUN", rotation=[math.radians(a) for a in turn])
    bpy.context.object.data.energy = strength
    bpy.context.object.data.angle = math.radians(angle)


def ambient(color, strength):
    world = bpy.data.worlds.new("ambient")
    world.use_nodes = True
    back = world.node_tree.nodes["Background"]
    back.inputs["Color"].default_value = color + (1,)
    back.inputs["Strength"].default_value = strength
    bpy.context.scene.world = world


def room(azimuth):
    plane(tile_material("floor", (0.42, 0.27, 0.15), (0.34, 0.20, 0.11), (0.16, 0.09, 0.05),
                        1.4, 0.16, gap=0.003), (14, 14), (0, 0, 0), (0, 0, azimuth + 90))
    wall(plain_material("wall", (0.62, 0.66, 0.64)), azimuth, 2.4, 14, 3.2)
    wall(plain_material("skirting", (0.82, 0.82, 0.80)), azimuth, 2.38, 14, 0.12)
    area_light((2.5, -2.0, 3.0), 1.0, 260, (1, 0.95, 0.88))
    area_light((1.0, 3.5, 2.6), 2.2, 60, (0.9, 0.95, 1))
    ambient((0.9, 0.95, 1.0), 0.35)


def court(azimuth):
    plane(tile_material("floor", (0.30, 0.33, 0.32), (0.22, 0.26, 0.26), (0.55, 0.55, 0.52),
                        0.6, 0.6, offset=0.0, gap=0.010), (40, 40), (0, 0, 0), (0, 0, 17))
    sun((38, -28, 20), 3.2, 6)
    ambient((0.75, 0.85, 1.0), 0.7)


def yard(azimuth):
    plane(tile_material("ground", (0.40, 0.38, 0.35), (0.35, 0.33, 0.31), (0.22, 0.21, 0.20),
                        0.5, 0.5), (40, 40), (0, 0, 0), (0, 0, azimuth + 70))
    wall(tile_material("bricks", (0.42, 0.17, 0.11), (0.33, 0.13, 0.09), (0.45, 0.42, 0.38),
                       0.24, 0.08, gap=0.008), azimuth, 3.0, 30, 1.6)
    sun((48, 18, 60), 2.8, 5)
    ambient((0.50, 0.70, 1.0), 0.9)


SCENES = {"room": room, "court": court, "yard": yard}


# ---- the camera ----

class Camera:
    def __init__(self, size, spec):
        self.width, self.height = size
        self.focal_px = spec["focal_px"]
        self.axes, self.at = self.place(spec)
        self.object = self.make()

    @staticmethod
    def place(spec):
        """Rows x right, y down, z forward in the world; and the centre."""
        a, e = math.radians(spec["azimuth"]), math.radians(spec["elevation"])
        back = Vector((math.cos(e) * math.cos(a), math.cos(e) * math.sin(a), math.sin(e)))
        forward = -back
        right = forward.cross(Vector((0, 0, 1))).normalized()
        roll = about(forward, spec["roll"])
        right, down = roll @ right, roll @ forward.cross(right)
        return Matrix((right, down, forward)), Vector(spec["target"]) + back * spec["distance"]

    def make(self):
        data = bpy.data.cameras.new("camera")
        data.sensor_fit = "HORIZONTAL"
        data.lens = self.focal_px * data.sensor_width / self.width
        obj = bpy.data.objects.new("camera", data)
        right, down, forward = self.axes
        turn = Matrix((right, -down, -forward)).transposed()
        obj.matrix_world = Matrix.Translation(self.at) @ turn.to_4x4()
        bpy.context.collection.objects.link(obj)
        bpy.context.scene.camera = obj
        return obj

    def to_cam(self, point):
        return self.axes @ (point - self.at)

    def project(self, cam):
        return (self.focal_px * cam.x / cam.z + self.width / 2 - 0.5,
                self.focal_px * cam.y / cam.z + self.height / 2 - 0.5)

    def blender_pixel(self, point):
        """Blender's own projection; its pixel edges are integers, ours are pixel centres."""
        u, v, _ = world_to_camera_view(bpy.context.scene, self.object, point)
        return u * self.width - 0.5, (1 - v) * self.height - 0.5

    def yaml(self):
        c = (self.focal_px, self.width / 2 - 0.5, self.height / 2 - 0.5)
        matrix = "%.1f, 0., %.1f, 0., %.1f, %.1f, 0., 0., 1." % (c[0], c[1], c[0], c[2])
        return ("%%YAML:1.0\n---\nimage_width: %d\nimage_height: %d\n"
                "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ %s ]\n"
                "distortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n"
                "   data: [ 0., 0., 0., 0., 0. ]\n" % (self.width, self.height, matrix))


def state(camera, name, point):
    """Whether a body surface lies well in front of the joint."""
    x, y = camera.blender_pixel(point)
    if not (-0.5 <= x < camera.width - 0.5 and -0.5 <= y < camera.height - 0.5):
        return "occluded"
    ray = point - camera.at
    hit, place, *_ = bpy.context.scene.ray_cast(
        bpy.context.evaluated_depsgraph_get(), camera.at, ray.normalized(), distance=ray.length)
    allowed = TRUNK_DEPTH_M if name in TRUNK_JOINTS else LIMB_DEPTH_M
    return "occluded" if hit and (point - place).length > allowed else "visible"


# ---- the files ----

def labels(image, camera, joints):
    marks = {}
    for name in BODY15:
        x, y = camera.blender_pixel(joints[name])
        marks[name] = {"x": round(x, 2), "y": round(y, 2),
                       "state": state(camera, name, joints[name])}
    people = [{"id": 0, "joints": marks}]
    return {"format": "poselift-labels", "version": 1, "layout": "body15",
            "frames": [{"image": image, "width": camera.width, "height": camera.height,
                        "people": people}]}


def truth(image, camera, joints):
    return {"image": image, "units": "m", "axes": "x right, y down, z forward", "frame": "cam",
            "joints_in_cam": {name: [round(c, 5) for c in camera.to_cam(joints[name])]
                              for name in BODY15 + sorted(set(joints) - set(BODY15))}}


def check(camera, exact, true):
    """The two files must tell the same story through the camera file's matrix."""
    marks = exact["frames"][0]["people"][0]["joints"]
    worst = 0.0
    for name, mark in marks.items():
        x, y = camera.project(Vector(true["joints_in_cam"][name]))
        worst = max(worst, math.hypot(x - mark["x"], y - mark["y"]))
    assert worst < MAX_DISAGREEMENT_PX, "projection and labels differ by %.3f px" % worst
    print("projection and labels agree within %.4f px" % worst)


def write_json(path, data):
    with open(path, "w") as f:
        json.dump(data, f, indent=1)
        f.write("\n")


def render(path, size):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"  # EEVEE needs a display
    scene.cycles.device = "CPU"
    scene.cycles.samples = SAMPLES
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.use_denoising = False
    scene.cycles.seed = 0
    scene.view_settings.view_transform = "Standard"
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "JPEG"
    scene.render.image_settings.quality = 90
    scene.render.use_file_extension = False
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)


def drop_comments(path):
    """Blender notes times in the JPEG: without them every run gives the same file."""
    with open(path, "rb") as f:
        data = f.read()
    kept, at = data[:2], 2
    while data[at + 1] != 0xDA:  # the picture itself starts here
        end = at + 2 + int.from_bytes(data[at + 2:at + 4], "big")
        if data[at + 1] != 0xFE:
            kept += data[at:end]
        at = end
    with open(path, "wb") as f:
        f.write(kept + data[at:])


def remove_the_rest():
    """The file brings its own floor, lamps and hidden collision shapes."""
    for obj in list(bpy.data.objects):
        if obj.type in ("MESH", "LIGHT") and not obj.name.startswith(MESH_PREFIX):
            bpy.data.objects.remove(obj)


def make(name, picture, outdir):
    bpy.ops.wm.open_mainfile(filepath=MODEL)
    remove_the_rest()
    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y = picture["size"]
    person = Person()
    person.pose(picture["pose"])
    camera = Camera(picture["size"], picture["camera"])
    joints = person.joints()
    exact = labels(name + ".jpg", camera, joints)
    true = truth(name + ".jpg", camera, joints)
    check(camera, exact, true)
    SCENES[picture["scene"]](picture["camera"]["azimuth"])
    base = os.path.join(os.path.abspath(outdir), name)
    write_json(base + ".exact.json", exact)
    write_json(base + ".truth.json", true)
    with open(base + ".camera.yaml", "w") as f:
        f.write(camera.yaml())
    render(base + ".jpg", picture["size"])
    drop_comments(base + ".jpg")


def main():
    args = sys.argv[sys.argv.index("--") + 1:]
    for name in args[1:] or PICTURES:
        make(name, PICTURES[name], args[0])


if __name__ == "__main__":
    main()
