#!/usr/bin/env python3
"""The packages of scripts/package, as a user has them: unpacked elsewhere, without the sources and the build of fxsdk.

BUILD names the build. Hosts in C99, C11, C++20 and Python use the shared and the static library by CMake and by pkg-config.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
BUILD = pathlib.Path(os.environ.get("BUILD", ROOT / "build"))
PYTHON = "/usr/bin/python3"  # the one that packages of Debian belong to


def run(*command, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, **options)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, command))} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


def packed(kind, folder):
    """What scripts/package makes. @param kind "deb" or "archive" """
    out = run(ROOT / "scripts/package", f"--{kind}", "-o", folder, env=os.environ | {"BUILD": str(BUILD)})
    return [pathlib.Path(line) for line in out.split()]


def drawn(path):
    """Whether a PNG file has more than one color: its rows do not compress to nothing."""
    return path.stat().st_size > 400


class Unpacked(unittest.TestCase):
    """Tests of what was unpacked into the folder `prefix`; the base of both kinds of packages."""
    prefix = None

    def setUp(self):
        if self.prefix is None:
            self.skipTest("a base")
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        libraries = list(self.prefix.rglob("libfxsdk.so.0"))
        self.assertEqual(len(libraries), 1)
        self.libraries = libraries[0].parent
        self.environment = {"PATH": os.environ["PATH"], "HOME": str(self.folder),
                            "PKG_CONFIG_PATH": str(self.libraries / "pkgconfig")}

    def test_hosts_by_cmake(self):
        for name in ("consumer.c", "consumer.cpp", "consumer_link.c"):
            shutil.copy(HERE / name, self.folder)
        shutil.copy(HERE / "CMakeLists.txt.in", self.folder / "CMakeLists.txt")
        run("cmake", "-S", self.folder, "-B", self.folder / "build", f"-DCMAKE_PREFIX_PATH={self.prefix}", env=self.environment)
        run("cmake", "--build", self.folder / "build", env=self.environment)
        for name in ("c11_shared", "c11_static", "cpp20_shared", "cpp20_static"):
            self.assertIn("particles", run(self.folder / "build" / name, env=self.environment), name)
        if any(self.prefix.rglob("fx_livelink.h")):
            for name in ("link_shared", "link_static"):
                environment = self.environment | {"XDG_RUNTIME_DIR": str(self.folder)}
                self.assertIn("listens at unix:", run(self.folder / "build" / name, env=environment), name)
            self.assertNotIn("libfxsdk", run("ldd", self.folder / "build/link_static"))
        shared = run("ldd", self.folder / "build/c11_shared")
        self.assertIn(str(self.libraries), shared)
        self.assertNotIn("libfxsdk", run("ldd", self.folder / "build/c11_static"))

    def test_the_first_example_as_a_project_of_its_own(self):
        shutil.copytree(self.prefix / "share/doc/fxsdk/examples", self.folder / "examples")
        build, picture = self.folder / "build", self.folder / "hello.png"
        run("cmake", "-S", self.folder / "examples/00_hello", "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}", env=self.environment)
        run("cmake", "--build", build, env=self.environment)
        run(build / "00_hello", "--headless", "--frames", "4", "--output", picture, env=self.environment)
        self.assertTrue(drawn(picture))

    def test_hosts_by_pkg_config(self):
        for module in ("fxsdk", "fxsdk-static"):
            flags = run("pkg-config", "--cflags", "--libs", module, env=self.environment).split()
            for standard, compiler, source in (("c99", "cc", "consumer.c"), ("c++20", "c++", "consumer.cpp")):
                program = self.folder / f"{module}-{standard}"
                run(compiler, f"-std={standard}", "-Wall", "-Wextra", "-Werror", "-pedantic-errors", HERE / source, "-o", program,
                    *flags, f"-Wl,-rpath,{self.libraries}", env=self.environment)
                self.assertIn("particles", run(program, env=self.environment))

    def test_python(self):
        package = next(self.prefix.rglob("dist-packages"))
        environment = self.environment | {"PYTHONPATH": str(package), "FX_INCLUDE": str(self.prefix / "include")}
        picture = self.folder / "campfire.png"
        run(PYTHON, "-m", "fxsdk", "campfire", "--time", "0.5", "--size", "48x32", "-o", picture, env=environment)
        self.assertTrue(drawn(picture))
        run(PYTHON, ROOT / "tests/packages/test_python.py", env=environment)
        blocks = re.findall(r"^```python\n(.*?)^```", (ROOT / "docs/howto/install.md").read_text(), re.MULTILINE | re.DOTALL)
        self.assertEqual(len(blocks), 3)
        program = "".join(blocks).replace("range(60)", "range(40)").replace("320", "64").replace("180", "36")
        self.assertIn("scene.camera", program)
        run(PYTHON, "-c", program, env=environment, cwd=self.folder)
        self.assertTrue(drawn(self.folder / "campfire.png"))

    def test_the_command(self):
        picture = self.folder / "campfire.png"
        run(self.prefix / "bin/fx", "render", "library:campfire", "--size", "48x32", "--time", "0.5", "-o", picture, env=self.environment)
        self.assertTrue(drawn(picture))
        presets = sorted((self.prefix / "share/fxsdk/presets").glob("*.fx.json"))
        self.assertEqual(len(presets), len(list((ROOT / "fxsdk/presets/library").glob("*.fx.json"))))
        run(self.prefix / "bin/fx", "validate", *presets, env=self.environment)
        for preset in presets: # to copy a preset, one needs its files
            for name in re.findall(r'"library:([^"]*\.[a-z]+)"', preset.read_text()):
                self.assertTrue((preset.parent / name).is_file(), f"{preset.name}: {name}")
        for kind in ("preset", "scene"):
            self.assertIn('"properties"', (self.prefix / f"share/fxsdk/schema/{kind}.schema.json").read_text())
        self.assertTrue((self.prefix / "share/doc/fxsdk/LICENSE").is_file())


class DebianPackages(Unpacked):
    @classmethod
    def setUpClass(cls):
        cls.work = pathlib.Path(tempfile.mkdtemp())
        cls.packages = packed("deb", cls.work / "packages")
        for package in cls.packages:
            run("dpkg", "-x", package, cls.work / "root")
        cls.prefix = cls.work / "root/usr"

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.work)

    def test_names_and_dependencies(self):
        depends = {}
        for package in self.packages:
            fields = run("dpkg-deb", "--field", package, "Package", "Depends")
            depends[re.search(r"Package: (\S+)", fields)[1]] = fields
        editor = {"libfxsdk-editor-dev"} if (BUILD / "lib/libfx_editor.a").exists() else set()
        self.assertEqual(set(depends), {"libfxsdk0", "libfxsdk-dev", "fxsdk-tools", "python3-fxsdk", "libfxsdk-doc"} | editor)
        for library in ("libtbb12", "libhwy1", "libxxhash0", "libc6"):
            self.assertIn(library, depends["libfxsdk0"])
        self.assertIn("libfxsdk0 (= ", depends["libfxsdk-dev"])
        self.assertIn("python3-numpy", depends["python3-fxsdk"])

    def test_files_that_headers_name_are_installed(self):
        texts = [path.read_text() for path in self.prefix.glob("include/fxsdk/*")]
        named = {name for text in texts for name in re.findall(r"\b(?:docs|examples)/[\w/.-]+\.\w+", text)}
        self.assertIn("examples/00_hello/main.c", named)
        for name in named:
            self.assertTrue((self.prefix / "share/doc/fxsdk" / name).is_file(), name)

    def test_missing_components_are_named(self):
        (self.folder / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.25)\nproject(game LANGUAGES C CXX)\nfind_package(fxsdk REQUIRED COMPONENTS ${WANTED})\n")
        configure = ("cmake", "-S", self.folder, f"-DCMAKE_PREFIX_PATH={self.prefix}", "-B")
        run(*configure, self.folder / "a", "-DWANTED=static", env=self.environment)
        with self.assertRaisesRegex(AssertionError, r"has\s+no\s+component\s+statics;\s+it\s+has\s+shared,\s+static"):
            run(*configure, self.folder / "b", "-DWANTED=statics", env=self.environment)


class Archive(Unpacked):
    @classmethod
    def setUpClass(cls):
        cls.work = pathlib.Path(tempfile.mkdtemp())
        archive, = packed("archive", cls.work / "packages")
        run("tar", "-xzf", archive, "-C", cls.work)
        cls.prefix, = (path for path in cls.work.iterdir() if path.name.startswith("fxsdk-"))

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.work)

    def test_brings_its_libraries_along(self):
        for file in (self.prefix / "bin/fx", self.libraries / "libfxsdk.so.0"):
            for name in ("tbb", "hwy", "xxhash"):
                found = re.search(rf"lib{name}\.so\S* => (\S+)", run("ldd", file))
                self.assertEqual(pathlib.Path(found[1]).parent.resolve(), self.libraries.resolve(), f"{file}: lib{name}")
        licenses = {path.name for path in (self.prefix / "share/doc/fxsdk/licenses").iterdir()}
        self.assertLessEqual({"libtbb12", "libhwy1", "libxxhash0"}, licenses)


class Editor(unittest.TestCase):
    """The component editor: a game outside of the tree compiles the panels with its own ImGui and draws frames of them."""

    def test_a_game_opens_the_editor_inside_of_itself(self):
        if not (BUILD / "lib/libfx_editor.a").exists():
            cache = (BUILD / "CMakeCache.txt").read_text()
            isWanted = all(re.search(line, cache, re.M) for line in (r"^FXSDK_IMGUI_LIBRARY:\w+=/", r"^FXSDK_EDITOR:BOOL=ON"))
            self.assertFalse(isWanted, "the build has found Dear ImGui, but there is no lib/libfx_editor.a: build fx_editor")
            self.skipTest("this build has no panels: Dear ImGui was missing")
        folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, folder)
        for component in ("runtime", "dev", "editor"):
            run("cmake", "--install", BUILD, "--prefix", folder / "sdk", "--component", component)
        game = folder / "game"
        game.mkdir()
        shutil.copy(HERE / "consumer_editor.cpp", game)
        shutil.copy(HERE / "CMakeLists.editor.txt.in", game / "CMakeLists.txt")
        configure = ("cmake", "-G", "Ninja", "-S", game, f"-DCMAKE_PREFIX_PATH={folder / 'sdk'}", "-DCMAKE_UNITY_BUILD=ON")
        with self.assertRaisesRegex(AssertionError, r"fxsdk_add_editor:\s+<glm/glm.hpp>\s+is\s+missing;\s+install\s+libglm-dev"):
            run(*configure, "-B", folder / "without", "-DCMAKE_IGNORE_PATH=/usr/include")
        run(*configure, "-B", game / "build")
        run("cmake", "--build", game / "build")
        preset = shutil.copy(ROOT / "fxsdk/presets/library/campfire.fx.json", game)
        out = run(game / "build/game", preset, folder / "recovery", cwd=folder)
        self.assertRegex(out, r"^\d+ particles, \d+ bright pixels, 0 pixels of the margin, \d+ pixels of the inspector, error 0")
        self.assertRegex(out, r"two editors: \d+ and \d+ particles, \d+ and \d+ pixels, error 0")
        self.assertFalse(list(folder.glob("sdk/share/fxsdk/editor/fxsdk/editor/program")))  # windows stay outside


class ExampleHosts(unittest.TestCase):
    """Each example host is a project of its own, which finds the installed package."""

    def test_hosts_are_built_from_the_installed_examples(self):
        folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, folder)
        for component in ("runtime", "dev", "doc"):
            run("cmake", "--install", BUILD, "--prefix", folder / "sdk", "--component", component)
        hosts = folder / "sdk/share/doc/fxsdk/examples/hosts"
        built = {path.name for path in (BUILD / "bin").glob("host_*")}
        self.assertIn("host_ldr", built)
        for host in ("deferred", "glfw_c", "ldr", "ogre", "sdl2"):
            if f"host_{host}" not in built:
                continue  # its library is missing
            run("cmake", "-G", "Ninja", "-S", hosts / host, "-B", folder / host, f"-DCMAKE_PREFIX_PATH={folder / 'sdk'}")
            targets = run("ninja", "-C", folder / host, "-t", "targets", "all")
            self.assertIn(f"host_{host}: ", targets)
        run("cmake", "--build", folder / "ldr")
        out = run(folder / "ldr/host_ldr", "--headless", folder / "ldr.png", "--frames", "20", "--size", "64x36")
        self.assertIn('"pixels_outside_changed": 0', out)
        self.assertTrue(drawn(folder / "ldr.png"))


class Sources(unittest.TestCase):
    """The sources as a part of another project, by add_subdirectory."""

    def test_the_library_alone_is_configured_as_documented(self):
        folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, folder)
        page = (ROOT / "docs/howto/install.md").read_text()
        line, = re.findall(r"^cmake -G Ninja -B build (.*)$", page, re.MULTILINE)
        run("cmake", "-G", "Ninja", "-S", ROOT, "-B", folder, *line.split())
        targets = set(re.findall(r"^(\S+): ", run("ninja", "-C", folder, "-t", "targets", "all"), re.MULTILINE))
        self.assertEqual({"fxsdk", "fxsdk_static"} - targets, set())
        self.assertEqual({"fx", "tests_unit", "00_hello"} & targets, set())

    def test_host_by_add_subdirectory(self):
        folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, folder)
        shutil.copy(HERE / "consumer.c", folder)
        (folder / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.25)\nproject(game LANGUAGES C CXX)\n"
            f"add_subdirectory({ROOT} fxsdk)\nadd_executable(game consumer.c)\n"
            "target_link_libraries(game PRIVATE fxsdk::fxsdk)\n")
        run("cmake", "-G", "Ninja", "-S", folder, "-B", folder / "build")
        targets = set(re.findall(r"^(\S+): ", run("ninja", "-C", folder / "build", "-t", "targets", "all"), re.MULTILINE))
        self.assertEqual({"game", "fxsdk"} - targets, set())
        self.assertEqual({"fx", "fxsdk_static", "fx_python", "tests_unit", "00_hello", "fx_exr"} & targets, set())  # not asked for
        if os.environ.get("FXSDK_LONG_RUN"):  # it builds the whole library
            run("cmake", "--build", folder / "build", "--target", "game")
            self.assertIn("particles", run(folder / "build/game"))


if __name__ == "__main__":
    if not shutil.which("dpkg-deb"):
        print("skipped: packages are made with the programs of Debian")
        sys.exit(77)
    unittest.main()
