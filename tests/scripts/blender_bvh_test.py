# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the poselift authors
"""Converts motions to BVH with our program, imports them in Blender and compares
every bone's head and tail with the places our own forward kinematics gives, from
the ASF/AMC and not from the BVH. Real: the program, Blender and, where the data is
there, a captured walk. Made up: a skeleton with CMU's axes and a motion of sines.

blender_bvh_test.py POSELIFT BONE_POSITIONS SCRATCH_DIR DATA_DIR
"""
import json
import math
import os
import shutil
import subprocess
import sys

SKIPPED = 77
EVERY = 20  # frames
TOLERANCE_M = 0.001
UNITS = {"m": 1.0, "cm": 0.01, "mm": 0.001}

# name, parent, direction, length, axis, dofs
BONES = [
    ("lhipjoint", "root", (0.66, -0.71, 0.25), 2.5, (0, 0, 0), ""),
    ("lfemur", "lhipjoint", (0.34202, -0.939693, 0), 7.4, (0, 0, 20), "rx ry rz"),
    ("ltibia", "lfemur", (0.34202, -0.939693, 0), 7.1, (0, 0, 20), "rx"),
    ("lfoot", "ltibia", (0.09, -0.25, 0.96), 2.2, (-90, 0, 20), "rx rz"),
    ("ltoes", "lfoot", (0, 0, 1), 1.1, (-90, 0, 20), "rx"),
    ("rhipjoint", "root", (-0.66, -0.71, 0.25), 2.5, (0, 0, 0), ""),
    ("rfemur", "rhipjoint", (-0.34202, -0.939693, 0), 7.4, (0, 0, -20), "rx ry rz"),
    ("rtibia", "rfemur", (-0.34202, -0.939693, 0), 7.1, (0, 0, -20), "rx"),
    ("rfoot", "rtibia", (-0.09, -0.25, 0.96), 2.2, (-90, 0, -20), "rx rz"),
    ("lowerback", "root", (0.01, 0.99, -0.06), 4.0, (0, 0, 0), "rx ry rz"),
    ("head", "lowerback", (0, 0.99, 0.05), 5.0, (0, 0, 0), "rx ry rz"),
    ("lclavicle", "lowerback", (0.96, 0.25, -0.05), 3.5, (0, 0, 0), "ry rz"),
    ("lhumerus", "lclavicle", (1, 0, 0), 4.8, (180, -30, -90), "rx ry rz"),
    ("rclavicle", "lowerback", (-0.96, 0.25, -0.05), 3.5, (0, 0, 0), "ry rz"),
    ("rhumerus", "rclavicle", (-1, 0, 0), 4.8, (180, 30, 90), "rx ry rz"),
    ("rradius", "rhumerus", (-1, 0, 0), 3.3, (180, 30, 90), "rx"),
]


def write_synthetic(folder):
    asf = [":version 1.10", ":name made_up", ":units", " mass 1", " length 0.45", " angle deg",
           ":root", " order TX TY TZ RX RY RZ", " axis XYZ", " position 0 0 0",
           " orientation 0 0 0", ":bonedata"]
    for name, _, direction, length, axis, dofs in BONES:
        asf += [" begin", "  name " + name, "  direction %g %g %g" % direction,
                "  length %g" % length, "  axis %g %g %g XYZ" % axis]
        asf += ["  dof " + dofs] if dofs else []
        asf += [" end"]
    asf += [":hierarchy", " begin"] + ["  %s %s" % (p, n) for n, p, *_ in BONES] + [" end"]
    amc = [":FULLY-SPECIFIED", ":DEGREES"]
    for frame in range(61):
        angle = [170 * math.sin(0.05 * frame + k) for k in range(3)]
        amc += [str(frame + 1), "root 3 17 %g %g %g %g" % (0.3 * frame, *angle)]
        for b, (name, *_, dofs) in enumerate(BONES):
            values = [70 * math.sin(0.1 * frame + b + k) for k in range(len(dofs.split()))]
            amc += ["%s %s" % (name, " ".join("%.6f" % v for v in values))] if values else []
    for ending, lines in (("asf", asf), ("amc", amc)):
        with open(os.path.join(folder, "synthetic." + ending), "w") as file:
            file.write("\n".join(lines) + "\n")
    return os.path.join(folder, "synthetic.amc")


def prepare(poselift, bone_positions, motion, unit, folder):
    stem = os.path.join(folder, os.path.splitext(os.path.basename(motion))[0] + "_" + unit)
    subprocess.run([poselift, "convert", motion, stem + ".bvh", "--units", unit], check=True)
    places = subprocess.run([bone_positions, motion, str(EVERY)], check=True,
                            stdout=subprocess.PIPE, universal_newlines=True).stdout
    return {"bvh": stem + ".bvh", "unit_m": UNITS[unit], "places": places}


def outside(poselift, bone_positions, folder, data):
    blender = shutil.which("blender")
    if not blender:
        print("SKIP: blender is not installed")
        return SKIPPED
    os.makedirs(folder, exist_ok=True)
    jobs = [prepare(poselift, bone_positions, write_synthetic(folder), unit, folder)
            for unit in UNITS]
    walk = os.path.join(os.environ.get("POSELIFT_DATA", data), "mocap/cmu/02/02_01.amc")
    if os.path.exists(walk):
        jobs.append(prepare(poselift, bone_positions, walk, "cm", folder))
    else:
        print("the captured walk is absent: only the made-up motion is compared")
    jobs_path = os.path.join(folder, "jobs.json")
    with open(jobs_path, "w") as file:
        json.dump(jobs, file)
    # Blender's own exit code is 0 whatever happens in a script.
    result_path = os.path.join(folder, "result.json")
    if os.path.exists(result_path):
        os.remove(result_path)
    subprocess.run([blender, "--background", "-noaudio", "--factory-startup", "--python",
                    os.path.abspath(__file__), "--", jobs_path, result_path], check=True)
    with open(result_path) as file:
        results = json.load(file)
    for result in results:
        print("%(bvh)s: %(compared)d bone ends compared, worst %(worst_m).7f m at %(where)s, "
              "%(stubs)d stubs" % result)
    ok = all(r["compared"] > 50 and r["worst_m"] < TOLERANCE_M and r["stubs"] == 0
             for r in results)
    return 0 if len(results) == len(jobs) and ok else 1


def in_file_axes(vector, unit_m):
    """Blender is Z-up: (x, y, z) of the file is (x, -z, y) there."""
    return (vector.x * unit_m, vector.z * unit_m, -vector.y * unit_m)


def compare(bpy, job):
    bpy.ops.import_anim.bvh(filepath=job["bvh"])
    armature = bpy.context.object
    result = {"bvh": job["bvh"], "compared": 0, "worst_m": 0.0, "where": "", "stubs": 0}
    # What the importer makes of a bone without length.
    result["stubs"] = sum(b.length * job["unit_m"] < 0.005 for b in armature.data.bones)
    shown = None
    for line in job["places"].splitlines():
        frame, name, *numbers = line.split()
        if frame != shown:
            bpy.context.scene.frame_set(int(frame) + 1)
            shown = frame
        bone = armature.pose.bones.get(name)
        if bone is None:
            assert name.endswith("hipjoint"), name
            continue
        ours = [float(n) for n in numbers]
        ends = [("head", bone.head, ours[:3])]
        if bone.parent:  # the tail of the root is Blender's own choice
            ends.append(("tail", bone.tail, ours[3:]))
        for end, theirs, place in ends:
            theirs = in_file_axes(armature.matrix_world @ theirs, job["unit_m"])
            result["compared"] += 1
            error = math.dist(theirs, place)
            if not error <= result["worst_m"]:
                result["worst_m"] = error
                result["where"] = "%s of %s, frame %s" % (end, name, frame)
    return result


def inside_blender(jobs_path, result_path):
    import builtins

    import bpy
    import io_anim_bvh.import_bvh as importer
    # Blender 3.4 opens files with a mode that Python 3.11 no longer has.
    importer.open = lambda path, mode="r", *args, **options: builtins.open(
        path, mode.replace("U", ""), *args, **options)
    with open(jobs_path) as file:
        jobs = json.load(file)
    results = [compare(bpy, job) for job in jobs]
    with open(result_path, "w") as file:
        json.dump(results, file)


if __name__ == "__main__":
    if "--" in sys.argv:
        inside_blender(*sys.argv[sys.argv.index("--") + 1:])
    else:
        sys.exit(outside(*sys.argv[1:]))
