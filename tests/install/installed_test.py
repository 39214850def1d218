#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Feature: installation
"""installed_test.py PLUGIN_FOLDER PREFIX LIBRARY_FOLDER INSTALL_TO BUILD MESON -- COMPILER...

Installs the build below a temporary folder, and uses only what is there: programs, scripts, plugin and examples, without
LD_LIBRARY_PATH and GST_PLUGIN_PATH."""
import os
import pathlib
import re
import shutil
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.environ["MTSTEREO_SOURCE"], "tests/pipelines"))
from support import RENDER, make_clip, make_videos, require, run

COMPILER = sys.argv[sys.argv.index("--") + 1:]
PLUGIN_FOLDER, PREFIX, LIBRARY_FOLDER, *INSTALL_TO = sys.argv[1:sys.argv.index("--")]
del sys.argv[1:]

PROGRAMS = ["mtcalibrate", "mtstereo-compare", "mtstereo-eval", "mtstereo-render", "mtstereo-run"]
SCRIPTS = ["mtstereo-from-cameras", "mtstereo-from-files", "mtstereo-from-network", "mtstereo-from-png",
           "mtstereo-from-side-by-side", "mtstereo-network-sender"]
ELEMENTS = ["mtstereo", "mtrectify", "mtsplit", "mtdepth", "mtcloud", "mtcolor", "mtconfidence", "mtwhole"]


FOLDER = pathlib.Path(tempfile.mkdtemp(prefix="mtstereo-"))
ROOT = FOLDER / "root"


def below(path):
    """Where a file or folder of the installation is below the temporary folder."""
    return ROOT / path.lstrip("/")


PLUGINS, LIBRARIES, PROGRAM_FOLDER = below(PLUGIN_FOLDER), below(LIBRARY_FOLDER), below(PREFIX) / "bin"


def setUpModule():
    unittest.addModuleCleanup(shutil.rmtree, FOLDER)
    require(run([*INSTALL_TO, ROOT], FOLDER))
    make_clip(FOLDER)
    make_videos(FOLDER)
    require(run([RENDER, "gray", "--gray", "--frames", "1", "--size", "320x240"], FOLDER))


class Installation(unittest.TestCase):
    def use(self, *command, **variables):
        """Runs a command as a user of the installation does."""
        variables = {"PATH": f"{PROGRAM_FOLDER}:/usr/bin:/bin", **variables}
        unset = [word for name in ("GST_PLUGIN_PATH", "GST_PLUGIN_PATH_1_0", "LD_LIBRARY_PATH", "BUILD")
                 for word in ("-u", name)]
        return run(["env", *unset, *(f"{name}={value}" for name, value in variables.items()), *command],
                   FOLDER)

    def assert_succeeds(self, outcome):
        self.assertEqual(outcome.status, 0, str(outcome))


class Installed(Installation):
    def test_programs_and_scripts_are_all_there_is_in_bin(self):
        self.assertEqual(sorted(file.name for file in PROGRAM_FOLDER.iterdir()),
                         sorted(PROGRAMS + SCRIPTS))

    def test_programs_run_with_the_installed_libraries(self):
        for program in PROGRAMS:
            self.assert_succeeds(self.use(program, "--help"))
            linked = self.use("ldd", PROGRAM_FOLDER / program)
            found = re.findall(r"(libmtstereo\S*) => (\S+)", linked.output)
            for name, file in found:
                self.assertTrue(os.path.samefile(LIBRARIES / name, file), str(linked))
        self.assertEqual(len(found), 2, str(linked))  # of mtstereo-run

    def test_mtstereo_run_uses_the_plugin_of_its_own_installation(self):
        done = self.use("mtstereo-run", "left.mp4", "right.mp4", "--out", "result",
                        GST_DEBUG="GST_PLUGIN_LOADING:4")
        self.assert_succeeds(done)
        self.assertTrue((FOLDER / "result/disparity.mkv").exists(), str(done))
        loaded = set(re.findall(r'plugin "([^"]*libgstmtstereo.so)"', done.errors))
        self.assertEqual(loaded, {str(PLUGINS / "libgstmtstereo.so")}, str(done))

    def test_images_are_read_and_written_by_the_module_of_the_installation(self):
        words = ["mtstereo-run", "gray/left", "gray/right", "--format", "png", "--quiet", "--out"]
        done = self.use(*words, "images", LD_DEBUG="files", LD_DEBUG_OUTPUT="loaded")
        self.assert_succeeds(done)
        self.assertEqual(len(list((FOLDER / "images").glob("**/*.png"))), 1)
        module = LIBRARIES / "mtstereo/libmtstereo-images.so"
        loaded = re.findall(r"file=(\S*/libmtstereo-images.so)", next(FOLDER.glob("loaded.*")).read_text())
        self.assertTrue(os.path.samefile(module, loaded[0]), loaded)
        module.rename(FOLDER / "away.so")
        self.addCleanup(lambda: (FOLDER / "away.so").rename(module))
        done = self.use(*words, "none")
        self.assertEqual(done.status, 1, str(done))
        self.assertRegex(done.errors, r"^mtstereo-run: images cannot be read or written: libmtstereo-images.so: .*: "
                                      r"install mtstereo again, .*\n$")

    def test_a_plugin_path_of_the_user_comes_first(self):
        folder = os.environ["MTSTEREO_BUILD"] + "/gst"
        for command, out in (("mtstereo-run", "other"), ("mtstereo-from-files", "other.mkv")):
            done = self.use(command, "left.mp4", "right.mp4", "--out", out, GST_DEBUG="GST_PLUGIN_LOADING:4",
                            GST_PLUGIN_PATH=folder)
            self.assert_succeeds(done)
            self.assertIn(f'plugin "{folder}/libgstmtstereo.so"', done.errors)

    def test_every_element_is_found_in_the_plugin_folder(self):
        for element in ELEMENTS:
            done = self.use("gst-inspect-1.0", element, GST_PLUGIN_PATH=PLUGINS)
            self.assert_succeeds(done)
            self.assertIn(str(PLUGINS / "libgstmtstereo.so"), done.output)

    def test_scripts_compute_disparities(self):
        (FOLDER / "maps").mkdir()
        for words in (["mtstereo-from-files", "left.mp4", "right.mp4", "--out", "files.mkv"],
                      ["mtstereo-from-side-by-side", "side-by-side.mp4", "--out", "maps/%06d.png"],
                      ["mtstereo-from-png", "left/%06d.png", "right/%06d.png", "png/%06d.png"]):
            self.assert_succeeds(self.use(*words))
        self.assertGreater((FOLDER / "files.mkv").stat().st_size, 1000)
        for made in ("maps", "png"):
            self.assertEqual(len(list((FOLDER / made).glob("*.png"))), 8)

    def test_scripts_work_through_a_link_of_the_user(self):
        (FOLDER / "disparities").symlink_to(PROGRAM_FOLDER / "mtstereo-from-files")
        self.assert_succeeds(self.use("./disparities", "left.mp4", "right.mp4", "--out", "link.mkv"))

    def test_scripts_print_their_pipelines(self):
        for words in (["mtstereo-from-cameras", "/dev/video0", "/dev/video2"],
                      ["mtstereo-from-network", "srt://:7001"],
                      ["mtstereo-network-sender", "left.mp4", "right.mp4"]):
            done = self.use(*words, "--dry-run")
            self.assert_succeeds(done)
            self.assertIn("gst-launch-1.0 -e ", done.output)
            self.assertIn(f"GST_PLUGIN_PATH={PLUGINS} ", done.output)

    def test_help_has_the_installed_names_and_no_build_folder(self):
        for script in SCRIPTS:
            done = self.use(script, "--help")
            self.assert_succeeds(done)
            self.assertTrue(done.output.startswith(script + " "), str(done))
            self.assertNotRegex(done.output, r"\.sh\b|\./pipelines|--build|\$BUILD|@")

    def test_wrong_use_is_refused_by_name(self):
        for words, says in ((["--build", "build"], "unknown option --build"),
                            (["--bogus"], "unknown option --bogus"), (["--out"], "--out needs a value")):
            done = self.use("mtstereo-from-files", "left.mp4", "right.mp4", *words)
            self.assertEqual(done.status, 2, str(done))
            self.assertIn("mtstereo-from-files: " + says, done.errors)

    def test_a_missing_plugin_is_reported(self):
        plugin = PLUGINS / "libgstmtstereo.so"
        plugin.rename(FOLDER / "away")
        self.addCleanup(lambda: (FOLDER / "away").rename(plugin))
        done = self.use("mtstereo-from-files", "left.mp4", "right.mp4", "--out", "none.mkv")
        self.assertEqual(done.status, 1, str(done))
        self.assertIn("the plugin is missing", done.errors)
        self.assertFalse((FOLDER / "none.mkv").exists())


class PythonModule(Installation):
    def test_is_installed_as_a_package_and_finds_its_library(self):
        if not os.environ["PYTHON_PACKAGE"]:
            self.skipTest("the Python module is not built (option python)")
        package = below(os.environ["PYTHON_PACKAGE"])
        self.assertLessEqual({"__init__.py", "__init__.pyi", "gst.py", "py.typed"},
                             {file.name for file in package.iterdir()})
        done = self.use("ldd", next(package.glob("_mtstereo*.so")))
        found = re.findall(r"(libmtstereo\S*) => (\S+)", done.output)
        self.assertTrue(found, str(done))
        for name, file in found:
            self.assertTrue(os.path.samefile(LIBRARIES / name, file), str(done))
        done = self.use(os.environ["PYTHON"], "-c", "import mtstereo; print(mtstereo.Matcher().parameters['mode'])",
                        PYTHONPATH=package.parent, PYTHONDONTWRITEBYTECODE="1")
        self.assertEqual(done.output, "semi-dense\n", str(done))


class Examples(Installation):
    """The installed examples, built as their users build them."""

    def flags(self, *packages):
        done = self.use("pkg-config", "--cflags", "--libs", *packages,
                        PKG_CONFIG_PATH=LIBRARIES / "pkgconfig",
                        PKG_CONFIG_SYSROOT_DIR=ROOT if packages[0] == "mtstereo" else "/")
        self.assert_succeeds(done)
        return done.output.split()

    def build(self, example, standard, *flags):
        source = below(PREFIX) / "share/doc/mtstereo/examples" / example
        program = FOLDER / f"{source.stem}-{standard}"
        self.assert_succeeds(run([*COMPILER, f"-std={standard}", "-Wall", "-Wextra", "-Werror", source, "-o",
                                  program, *flags], FOLDER))
        return program

    def pixels(self, image):
        """The values of a 16-bit image."""
        require(self.use("gst-launch-1.0", "-q", "filesrc", f"location={image}", "!", "pngdec", "!", "filesink",
                         "location=pixels"))
        return (FOLDER / "pixels").read_bytes()

    def test_the_library_gives_the_disparities_of_the_element(self):
        require(self.use("mtstereo-from-png", "gray/left/%06d.png", "gray/right/%06d.png", "element-%06d.png",
                         "--max-disparity", "48"))
        expected = self.pixels("element-000000.png")
        self.assertEqual(len(expected), 320 * 240 * 2)
        opencv = ["-isystem", "/usr/include/opencv4", "-lopencv_core", "-lopencv_imgcodecs"]
        for standard in os.environ["CPP_STANDARDS"].split():
            program = self.build("match_pair.cpp", standard, *self.flags("mtstereo"), *opencv)
            done = self.use(program, "gray/left/000000.png", "gray/right/000000.png", "48", f"{standard}.png",
                            "confidence.png", LD_LIBRARY_PATH=LIBRARIES)
            self.assert_succeeds(done)
            self.assertRegex(done.output, r"^density [1-9]\d\.\d %, rows corrected by up to \d\.\d\d px")
            self.assertEqual(self.pixels(f"{standard}.png"), expected)
            self.assertTrue((FOLDER / "confidence.png").exists())
        for words, says in ((["nothing.png", "gray/right/000000.png", "48"], "nothing.png is missing"),
                            (["gray/left/000000.png"] * 2 + ["0"], "max-disparity")):
            done = self.use(program, *words, "no.png", "no.png", LD_LIBRARY_PATH=LIBRARIES)
            self.assertEqual(done.status, 1, str(done))
            self.assertIn(says, done.errors)

    def test_the_sample_of_an_application_builds_and_runs(self):
        gstreamer = ["gstreamer-1.0", "gstreamer-app-1.0", "gstreamer-video-1.0"]
        program = self.build("depth_of_center.cpp", "c++20", *self.flags(*gstreamer))
        done = self.use(program, "left.mp4", "right.mp4", "136", "0.1", GST_PLUGIN_PATH=PLUGINS)
        self.assert_succeeds(done)
        self.assertEqual(len(done.output.splitlines()), 8, str(done))


if __name__ == "__main__":
    unittest.main(verbosity=2)
