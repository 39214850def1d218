#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""seeds.py LIST: writes the first inputs of every fuzzing program to seeds/PROGRAM/ next to LIST, and their names
to LIST. The programs read their inputs byte by byte, see their FuzzInput."""
import json
import pathlib
import struct
import sys
import zlib


def png(width, height, depth, color, rows):
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    pixels = b"".join(b"\0" + row for row in rows)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, depth, color, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(pixels)) + chunk(b"IEND", b""))


def files():
    values = struct.pack("<6f", 1, 2.5, -3, float("inf"), float("nan"), 0)
    yield "pfm-little", b"\0" + b"Pf\n3 2\n-1.0\n" + values
    yield "pfm-big", b"\0" + b"Pf # map\n3\n2 1.0\n" + values
    yield "pfm-color", b"\0" + b"PF\n1 1\n1\n" + values
    yield "png-gray8", b"\1" + png(4, 2, 8, 0, [b"\0\1\2\3", b"\4\5\6\7"])
    yield "png-gray16", b"\1" + png(2, 2, 16, 0, [b"\0\1\2\3", b"\4\5\6\7"])
    yield "view-rgb", b"\2" + png(1, 2, 8, 2, [b"\0\1\2", b"\4\5\6"])
    yield "view-rgba", b"\2" + png(1, 1, 8, 6, [b"\0\1\2\3"])
    yield "dmap", b"\3" + bytes([1, 2]) + struct.pack(">6f", 1, 2, 3, 4, 1e6, -1)
    yield "camera", b"\4" + b"500 500 320 240 1 0 0 0 0.1 0 0\n"
    yield "calibration", b"\5\0cam0=[1 0 0; 0 1 0; 0 0 1]\nwidth=640\nndisp=64\n"
    yield "calibration-eth3d", b"\5\1width=640\nndisp=32 \n"


def jpeg(frame, data=True):
    """A gray image of 8x8 px, whose tables have one code each."""

    def segment(kind, body):
        return bytes([0xff, kind]) + struct.pack(">H", len(body) + 2) + body

    code = bytes([1] + 15 * [0] + [0])
    return (b"\xff\xd8" + segment(0xdb, bytes([0] + 64 * [1])) + segment(frame, bytes([8, 0, 8, 0, 8, 1, 1, 0x11, 0])) +
            segment(0xc4, b"\0" + code + b"\x10" + code) + segment(0xda, bytes([1, 1, 0, 0, 63, 0])) +
            (b"\x3f\xff\xd9" if data else b""))


def tiff(order, pages):
    """Directories without pixels: width and height, of 16 and of 32 bits."""
    places = [8 + 30 * page for page in range(pages)] + [0]
    return (b"MM\0*" if order == ">" else b"II*\0") + struct.pack(order + "I", places[0]) + b"".join(
        struct.pack(order + "HHHIHHHHIII", 2, 256, 3, 1, 640, 0, 257, 4, 1, 480, following) for following in places[1:])


def big_tiff(order):
    return (b"MM\0+\0\x08\0\0" if order == ">" else b"II+\0\x08\0\0\0") + struct.pack(
        order + "QQHHQHHIHHQQQ", 16, 2, 256, 3, 1, 640, 0, 0, 274, 4, 1, 8, 0)


def chunk(name, *parts):
    body = b"".join(parts)
    return struct.pack(">I", len(body) + 8) + name + body


def transport_stream(length):
    """Three packets of one PID, the first of which starts a frame."""
    packets = [b"G" + bytes([0x40 * (i == 0) + 1, 0, 0x10 + i]) + b"\0\0\1\xe0\0\0" + bytes(178) for i in range(3)]
    return b"".join((bytes(4) if length == 192 else b"") + packet + bytes(16 if length == 204 else 0)
                    for packet in packets)


def ogg(*pages):
    def checksum(body):
        value = 0
        for byte in body:
            value ^= byte << 24
            for _ in range(8):
                value = (value << 1 ^ (0x04c11db7 if value & 1 << 31 else 0)) & 0xffffffff
        return value

    for number, body in enumerate(pages):
        kind = 2 * (number == 0) + 4 * (number + 1 == len(pages))
        head = b"OggS\0" + bytes([kind]) + struct.pack("<QII", number, 7, number)
        tail = bytes([1, len(body)]) + body
        yield head + struct.pack("<I", checksum(head + bytes(4) + tail)) + tail


def media():
    yield "png", b"\0" + png(4, 2, 8, 0, [b"\0\1\2\3", b"\4\5\6\7"])
    yield "jpeg-size", b"\0" + jpeg(0xc0)
    for order, name in (("<", "little"), (">", "big")):
        for pages in (1, 2):
            yield f"tiff-{name}-{pages}", b"\1\0" + tiff(order, pages)
        yield f"tiff-{name}-8-bytes", b"\1\0" + big_tiff(order)
    animated = png(1, 1, 8, 0, [b"\0"])
    yield "png-animated", b"\1\1" + animated[:33] + struct.pack(">I", 8) + b"acTL" + bytes(12) + animated[33:]
    for name, start in (("jpeg-stream", jpeg(0xc0)), ("gif", b"GIF89a"), ("lfs", b"version https://git-lfs")):
        yield name, b"\1\2" + start
    table = chunk(b"stsz", struct.pack(">5I", 0, 0, 2, 5, 6))
    moov = chunk(b"moov", chunk(b"trak", chunk(b"mdia", chunk(b"minf", chunk(b"stbl", table)))), b"lhvC")
    yield "mp4", b"\2" + chunk(b"ftyp", b"isom") + moov + chunk(b"mdat", bytes(11))
    yield "mp4-large", b"\2" + chunk(b"free") + struct.pack(">I4sQ", 1, b"mdat", 18) + b"ab" + bytes(4) + b"moov"
    block = b"\xe7\x81\x05\xa3\x85\x81\0\0\x80x"
    cluster = b"\x1f\x43\xb6\x75"
    yield "matroska", (b"\2\x1a\x45\xdf\xa3\x80\x18\x53\x80\x67\xff" + cluster + bytes([0x80 + len(block)]) + block +
                       cluster + bytes([0x86 + len(block)]) + b"\xbf\x84" + struct.pack("<I", zlib.crc32(block)) + block)
    yield "avi", b"\2RIFF" + struct.pack("<I", 5) + b"AVI x\0"
    yield "asf", b"\2" + (bytes.fromhex("3026b275") + bytes(12) + struct.pack("<Q", 26) + b"ab") * 2
    yield "flv", b"\2FLV\1\5\0\0\0\x09\0\0\0\0" + (b"\x09\0\0\2" + bytes(7) + b"ab\0\0\0\x0d") * 2
    yield "ogg", b"\2" + b"".join(ogg(b"first", b"second"))
    for length in (188, 192, 204):
        yield f"transport-{length}", b"\2" + transport_stream(length)
    for frame in (0xc0, 0xc2):
        yield f"jpeg-{frame:x}", b"\3" + jpeg(frame)
    yield "jpeg-cut", b"\3" + jpeg(0xc0, data=False)


def text():
    yield "numbers", b"\0max-disparity=64\nmax-node-width=0.5\ncensus-kernel-size=3\npixel-confidence=1e1\n"
    yield "words", b"\0preset=fast\nmode=semi-dense\ncost=gradient\nsubpixel=false\nnoise-filter=1\n"
    yield "levels", b"\0node-levels=5,3,0\nnode-levels=0\nnode-levels=1,1\n"
    yield "wrong", b"\0threads=-1\nmax-disparity=nan\nmode=\nno-such=1\nmode\n"
    yield "field", b"\1" + b"0.5,-0.1,0,1e-3,0"
    yield "field-wrong", b"\1" + b"0.5,,0,inf,101"
    for index, kind in enumerate(("noise=5", "jpeg=20", "h264=40", "dark=0.3", "bright=2", "blur-right=1.5",
                                  "lower-right=-2", "roll-right=1", "gain-right=0.5", "gamma-right=2", "noise=x", "rim",
                                  "rimcam", "cam", "cam2x", "cam1.5x", "soft2x", "soft1.5x", "blur=0.7", "cam=1")):
        yield f"degradation-{index}", b"\2" + kind.encode() + b"\n" + bytes([20, 10, 100])
    yield "layout", b"\3" + b"middlebury"


def matcher():
    # count of parameters, (index, share)..., correction, width, height, padding and offset of both, scale, shift,
    # related, then the paint of the left view
    frame = bytes([63, 15, 3, 1, 0, 0]) + struct.pack("<H", 256) + bytes([4, 1])
    paint = bytes([2, 128, 200, 5, 1, 0])
    yield "default", bytes([0, 1]) + frame + paint
    yield "flat", bytes([0, 1]) + frame + bytes([0, 128, 0, 0, 0, 0])
    for index in range(40):
        yield f"parameter-{index}", bytes([1, index]) + struct.pack("<H", 0x7000) + b"\1" + frame + paint
    for preset in (0x8000, 0xffff):
        yield f"preset-{preset}", bytes([1, 0]) + struct.pack("<H", preset) + b"\1" + frame + paint
    yield "correction", bytes([0, 0, 160, 1, 140, 0, 128, 0, 128, 1, 128, 0, 1, 0]) + frame + paint
    yield "two-frames", (bytes([0, 1]) + frame + paint + bytes([0])) * 2


def alignment():
    # action, paddings, offsets, shift, down, paint, how the right view is made, disturbances, range
    step = bytes([1, 0, 0, 3, 1, 24, 11]) + bytes([2, 128, 255, 3, 1, 0]) + bytes([1, 0, 60])
    sized = bytes([7, 149, 89]) + step[1:]
    yield "one-pair", step
    yield "several-pairs", step * 5
    yield "sizes", step + sized + step
    yield "reset", step + bytes([15]) + sized[1:]
    yield "restore", bytes([14, 130]) + step[1:] + step * 4
    yield "bytes", bytes([1, 0, 0, 3, 1, 24, 11, 4, 0, 0, 0, 0, 0]) + bytes(range(256)) * 8


def caps():
    gray = b"video/x-raw,format=GRAY8,width=32,height=16,framerate=30/1\n"
    disparity = b"video/x-raw,format=GRAY16_LE,width=32,height=16,framerate=30/1,disparity-scale=256,max-disparity=8\n"
    yield "gray", b"\0" + gray * 2 + b"video/x-raw,format=GRAY16_LE"
    yield "sizes", b"\0" + gray + gray.replace(b"32", b"48") + b"video/x-raw"
    yield "planar", b"\0" + gray.replace(b"GRAY8", b"I420") + gray.replace(b"GRAY8", b"NV12") + b"ANY"
    yield "packed", b"\0" + gray.replace(b"GRAY8", b"YUY2") + gray.replace(b"GRAY8", b"RGBA")
    yield "choice", b"\0video/x-raw,format={GRAY8,I420},width=[1,64],height=[1,max],framerate=[0/1,60/1]\n" + gray
    yield "interlaced", b"\0" + gray[:-1] + b",interlace-mode=mixed\n" + gray
    yield "features", b"\0video/x-raw(memory:GLMemory),format=RGBA,width=8,height=8\n" + gray
    yield "encoded", b"\0video/x-h264,stream-format=avc\nimage/jpeg\n"
    yield "downstream", b"\0" + gray * 2 + b"video/x-raw,format=GRAY16_LE,width=64,height=[1,100]"
    yield "color", b"\1" + disparity * 2 + b"video/x-raw,format={RGB,BGRx}"
    yield "color-range", b"\1" + disparity.replace(b"256", b"-1") + disparity.replace(b"=8", b"=0")
    yield "confidence", b"\2" + disparity + gray + b"video/x-raw"
    geometry = b",focal-length=40.0,baseline=0.1,principal-offset=1.5,principal-x=16.0,principal-y=8.0"
    yield "depth", b"\3" + disparity.replace(b"\n", geometry + b"\n") * 2 + b"video/x-raw"
    yield "depth-wrong", b"\3" + disparity[:-1] + b",focal-length=-1.0,baseline=1e300\n" + gray
    yield "rectify", b"\4" + gray * 2 + b"video/x-raw,format=GRAY8"
    yield "rectify-color", b"\4" + gray.replace(b"GRAY8", b"BGR") * 2 + b"video/x-raw,width=[1,20]"
    yield "rectify-sizes", b"\4" + gray + gray.replace(b"32", b"64") + b"video/x-raw"
    yield "split", b"\5" + gray.replace(b"GRAY8", b"I420") + gray.replace(b"32", b"33") + b"video/x-raw"
    yield "cloud", b"\6" + disparity + gray.replace(b"GRAY8", b"RGB") + disparity.replace(b"32", b"16")
    yield "cloud-geometry", b"\6" + disparity.replace(b"\n", geometry + b"\n") + gray + disparity


def streams():
    def frame(side, index, kind=0, more=1):
        return bytes([64 * side, kind, index, 0, more])

    pairs = b"".join(frame(0, i) + frame(1, i) for i in range(8))
    yield "pairs", b"\0\1" + pairs
    yield "live", b"\1\1" + pairs
    yield "not-started", b"\0\0" + pairs
    yield "lost", b"\0\1" + b"".join(frame(0, i) + (frame(1, i) if i % 3 else b"") for i in range(8))
    yield "no-times", b"\0\1" + bytes([0, 0, 240, 0, 0, 64, 0, 240, 0, 0]) * 4
    yield "sizes", b"\0\1" + frame(0, 0, 2) + frame(1, 0) + frame(0, 1) + frame(1, 1, 2)
    for kind in (12, 13, 14, 15):
        yield f"meta-{kind}", b"\0\1" + bytes([0, kind, 0, 20, 1, 0, 1]) + frame(1, 0) + pairs
    for caps_index in range(12):
        change = bytes([16, caps_index, 16 + 64, caps_index])
        yield f"caps-{caps_index}", b"\0\1" + pairs[:20] + change + pairs[20:]
    for action, parameters in ((17, (1, 0, 1)), (18, (2, 0, 3, 0)), (19, (1, 1, 1)), (20, ()), (21, (0, 9)), (21, (4,)),
                               (22, (0, 2, 0, 3, 0)), (22, (3, 1)), (23, ()), (26, (1,)), (26, (0,)), (27, (200,)),
                               (28, ())):
        for side in (0, 64):
            name = "-".join(str(n) for n in (action + side, *parameters))
            yield f"action-{name}", b"\0\1" + pairs[:20] + bytes([action + side, *parameters]) + pairs[20:]
    for index in range(28):
        yield f"property-{index}", b"\0\1" + pairs[:20] + bytes([24, index]) + pairs[20:]


def matrix(name, rows, columns, values, gap=" "):
    return f"{name}: !!opencv-matrix\n   rows: {rows}\n   cols: {columns}\n   dt: d\n   data:{gap}{values}\n"


def calibrations_of_slam():
    pose = "[1, 0, 0, {}, 0, 1, 0, 0, 0, 0, 1, 0.01, 0, 0, 0, 1]"
    camera = ("  camera_model: pinhole\n  intrinsics: [310, 311, 322, 241]\n  distortion_model: equidistant\n"
              "  distortion_coeffs: [0.01, 0, 0, 0]\n  resolution: [640, 480]\n")
    yield "imu-chain", ("\0\0%YAML:1.0\n" + "".join(
        f"cam{i}:\n{camera}  T_imu_cam: {pose.format(0.12 * i)}\n" for i in range(2))).encode()
    names = "".join(f"Camera{i}.{name}: {value}\n" for i in (1, 2)
                    for name, value in (("fx", 310), ("fy", 311), ("cx", 322), ("cy", 241), ("k1", 0.1), ("k2", 0)))
    size = "Camera.width: 640\nCamera.height: 480\n"
    for kind in ("PinHole", "KannalaBrandt8"):
        yield "orbslam-" + kind, (f"\0\0%YAML:1.0\nCamera.type: {kind}\n{names}{size}" +
                                  matrix("Stereo.T_c1_c2", 4, 4, pose.format(0.12), "")).encode()
    yield "orbslam-rectified", ("\0\0%YAML:1.0\nCamera.type: Rectified\n" + names[:names.index("Camera1.k1")].replace(
        "311", "310") + size + "Stereo.b: 0.12\n").encode()
    k, d, r = "[310, 0, 322, 0, 311, 241, 0, 0, 1]", "[0.1, 0, 0, 0]", "[1, 0, 0, 0, 1, 0, 0, 0, 1]"
    p = "[310, 0, 322, {}, 0, 310, 241, 0, 0, 0, 1, 0]"
    yield "projections", ("\1\0%YAML:1.0\n" + "".join(
        matrix(side + ".K", 3, 3, k, "") + matrix(side + ".D", 1, 4, d) + matrix(side + ".R", 3, 3, r) +
        matrix(side + ".P", 3, 4, p.format(fourth)) for side, fourth in (("LEFT", 0), ("RIGHT", -31)))).encode()
    yield "structure", (f"\1\0left: {{A: {k}, B: {d}}}\nright: {{A: {k}, B: {d}}}\nrot: {r}\n"
                        "pos: [-0.12, 0, 0]\n").encode()
    # A byte of 2 separates the file that this one names.
    yield "vins", ("\0\0%YAML:1.0\ncam0_calib: second\ncam1_calib: second\n" +
                   matrix("body_T_cam0", 4, 4, pose.format(0)) + matrix("body_T_cam1", 4, 4, pose.format(0.12)) +
                   "\2%YAML:1.0\nmodel_type: PINHOLE\nimage_width: 640\nimage_height: 480\ndistortion_parameters:\n"
                   "   {k1: 0.1, k2: 0, p1: 0, p2: 0}\nprojection_parameters: {fx: 310, fy: 311, cx: 322, cy: 241}\n"
                   ).encode()
    yield "ov2slam", ("\0\0%YAML 1.0\n---\n" + "".join(
        f"Camera.model_{side}: {model}\nCamera.{side}_nwidth: 640\nCamera.{side}_nheight: 480\n" + "".join(
            f"Camera.{name}{side[0]}: {value}\n" for name, value in (
                ("fx", 310), ("fy", 311), ("cx", 322), ("cy", 241), ("k1", 0.1), ("k2", 0), ("p1", 0), ("p2", 0)))
        for side, model in (("left", "pinhole"), ("right", "fisheye"))) +
        f"body_T_cam0: {pose.format(0)}\nbody_T_cam1: {pose.format(0.12)}\n").encode()
    yield "omni", ("\0\0%YAML:1.0\n" + "".join(f"cam{i}:\n{camera}" for i in range(2)) +
                   f"  T_cn_cnm1: {pose.format(-0.12)}\n").replace("pinhole", "omni").replace(
                       "[310, 311", "[0.8, 834, 831").replace("equidistant", "radtan").encode()
    okvis = ("{{T_SC: {}, image_dimension: [640, 480], distortion_coefficients: [0.1, 0, 0, 0], distortion_type: "
             "equidistant, focal_length: [310, 311], principal_point: [322, 241]}}")
    yield "K.txt", b"\1\0310 0 322 0 310 241 0 0 1\n0.12\n"
    yield "okvis", ("\0\0%YAML:1.0\ncameras:\n" + "".join(
        f"  - {okvis.format(pose.format(x))}\n" for x in (0, 0.12))).encode()
    svo = ("{{camera: {{image_width: 640, image_height: 480, type: pinhole, intrinsics: [310, 311, 322, 241], "
           "distortion: {{type: none, parameters: []}}}}, T_B_C: {}}}")
    yield "svo", ("\0\0sensors:\n  - cameras:\n" + "".join(
        f"    - {svo.format(pose.format(x))}\n" for x in (0, 0.12))).encode()
    yield "spectacular-ai", b"\0\0" + json.dumps({"cameras": [
        {"focalLengthX": 310, "focalLengthY": 311, "principalPointX": 322, "principalPointY": 241, "model": model,
         "distortionCoefficients": [0.1, 0, 0, 0], "imageWidth": 640, "imageHeight": 480,
         "imuToCamera": [[1, 0, 0, x], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}
        for model, x in (("kannala-brandt4", 0), ("brown-conrady", -0.12))]}).encode()
    yield "stella", (
        "\0\0Camera: {setup: stereo, model: perspective, fx: 310, fy: 310, cx: 322, cy: 241, cols: 640, rows: 480, "
        f"focal_x_baseline: 31}}\nStereoRectifier: {{model: fisheye, K_left: {k}, K_right: {k}, D_left: {d}, "
        f"D_right: {d}, R_left: {r}, R_right: {r}}}\n").encode()
    yield "basalt", b"\0\0" + json.dumps({"value0": {
        "T_imu_cam": [{"px": x, "py": 0, "pz": 0, "qx": 0, "qy": 0, "qz": 0, "qw": 1} for x in (0, 0.12)],
        "intrinsics": [{"camera_type": kind, "intrinsics": dict(
            fx=310, fy=311, cx=322, cy=241, k1=0.1, k2=0, k3=0, k4=0, k5=0, k6=0, p1=0, p2=0)}
            for kind in ("kb4", "pinhole-radtan8")], "resolution": [[640, 480], [640, 480]]}}).encode()
    yield "mrcal", b"\0\0" + b"\1".join(
        b"# by hand\n{ 'lensmodel': '%b', 'intrinsics': [ 310, 311, 322, 241, %b],\n  # rt\n"
        b"'extrinsics': [ 0, 0.1, 0, %b, 0, 0,],\n'imagersize': [ 640, 480,],\n'optimization_inputs': b'P){0',\n}\n" %
        case for case in ((b"LENSMODEL_PINHOLE", b"", b"0"), (b"LENSMODEL_OPENCV4", b"0.1, 0, 0, 0,", b"-0.12")))
    ini = "[image]\nwidth\n640\nheight\n480\n[c]\n" + "".join(
        f"{name}\n{values.replace(',', '')[1:-1]}\n" for name, values in
        (("camera matrix", k), ("distortion", "[0.1, 0, 0, 0, 0]"), ("rectification", r), ("projection", p)))
    yield "ost.txt", ("\0\0# oST\n" + ini.format(0) + ini.format(-31)).encode()
    yield "ini", ("\0\0" + ini.format(0) + "\1" + ini.format(-31)).encode()
    info = ("height: 480\nwidth: 640\ndistortion_model: plumb_bob\nd: [0.1, 0, 0, 0, 0]\nk: " + k + "\nr: " + r +
            "\np: {}\nbinning_x: 2\nbinning_y: 2\nroi: {{x_offset: 4, y_offset: 6, height: 360, width: 560}}\n")
    yield "both-infos", ("\0\0" + info.format(p.format(0)) + "---\n" + info.format(p.format(-31))).encode()
    table = (f"matrix = {k}\ndistortions = {d}\nsize = [640, 480]\nrotation = [0, 0, 0.1]\n"
             "translation = [{}, 0, 0]\n")
    yield "tables", ("\0\0" + "".join(f"[cam_{i}]\n" + table.format(-0.12 * i) for i in range(2))).encode()
    yield "toml-assertion", b"\0\0x = [1]\n[*a]\ny = 1\n"
    yield "toml-letter", "\0\0[a]\nb = [3é]\n".encode()
    airslam = "cam{}:\n  intrinsics: [310, 311, 322, 241]\n  distortion_coeffs: [0.1, 0, 0, 0, 0]\n  T_type: {}\n  T: {}\n"
    yield "airslam", ("\0\0image_width: 640\nimage_height: 480\ndistortion_type: 2\n" + "".join(
        airslam.format(i, i, pose.format(0.12 * i)) for i in range(2))).encode()
    parameters = {name: {"val": 0.1} for name in "k1 k2 k3 k4 k5 k6 p1 p2 s1 s2 s3 s4 tauX tauY".split()}
    parameters |= {"f": {"val": 310}, "ar": {"val": 1}, "cx": {"val": 322}, "cy": {"val": 241}}
    base = {"CameraModelBase": {"imageSize": {"width": 640, "height": 480}}}
    model = {"polymorphic_name": "libCalib::CameraModelOpenCV",
             "ptr_wrapper": {"data": {"CameraModelCRT": base, "parameters": parameters}}}
    yield "calib.io", b"\0\0" + json.dumps({"Calibration": {"cameras": [
        {"model": model, "transform": {"rotation": {"rx": 0, "ry": 0.1, "rz": 0},
                                       "translation": {"x": x, "y": 0, "z": 0}}} for x in (0, -0.12)]}}).encode()
    yield "appended", (f"\1\0%YAML:1.0\n---\nK1: {k}\nD1: {d}\n...\n---\nK2: {k}\nD2: {d}\n...\n---\n"
                       f"R: {r}\nT: [-0.12, 0, 0]\n").encode()
    yield "omnidir", (f"\1\0K1: {k}\nD1: {d}\nxi1: 0.8\nK2: {k}\nD2: {d}\nxi2: 0.9\nrvec: [0, 0.1, 0]\n"
                      "T: [-0.12, 0, 0]\n").encode()
    yield "region", ("\0\0" + info.format(p.format(0)) + "\1" + info.format(p.format(-31))).encode()


def calibration():
    folder = pathlib.Path(__file__).parent.parent / "geometry" / "files"
    pairs = (("intrinsics.yml", "extrinsics.yml"), ("camera_info_left.yaml", "camera_info_right.yaml"),
             ("euroc_cam0.yaml", "euroc_cam1.yaml"))
    for left, right in pairs:
        yield left, b"\0\0" + (folder / left).read_bytes() + b"\1" + (folder / right).read_bytes()
    single = (("calib_cam_to_cam.txt", 0, 0), ("camchain.yaml", 0, 0), ("kitti_calib.txt", 1, 1),
              ("middlebury_calib.txt", 0, 0), ("SN12345.conf", 2, 0))
    for name, size, selection in single:
        yield name, bytes([size, selection]) + (folder / name).read_bytes()
    board = json.loads((folder / "depthai.json").read_text())
    yield "depthai.json", b"\0\0" + json.dumps(board, separators=(",", ":")).encode()
    yield from calibrations_of_slam()
    yield "opencv.xml", (b"\1\0<?xml version=\"1.0\"?>\n<opencv_storage>\n<M1 type_id=\"opencv-matrix\">\n"
                         b"  <rows>1</rows>\n  <cols>2</cols>\n  <dt>d</dt>\n  <data>\n    1. 2e3</data></M1>\n"
                         b"<size>640 480</size><s>&lt;</s><l><_>1</_><_>2</_></l></opencv_storage>\n")
    yield "aliases", b"\0\0a: &a [1, 2]\nb: *a\nM1: {rows: 1, cols: 2, dt: d, data: *a}\n"


def main():
    out = pathlib.Path(sys.argv[1])
    names = []
    for program in (alignment, calibration, caps, files, matcher, media, streams, text):
        folder = out.parent / "seeds" / program.__name__
        folder.mkdir(parents=True, exist_ok=True)
        for name, content in program():
            (folder / name).write_bytes(content)
            names.append(f"{program.__name__}/{name}")
    out.write_text("\n".join(names) + "\n")


if __name__ == "__main__":
    main()
