#!/usr/bin/env python3
"""The fx program: exit codes, messages, machine-readable output, full disks."""
import json
import unittest

from fx_program import LIBRARY, FxTest, fx


class FxCommand(FxTest):
    def test_help_describes_every_subcommand_and_succeeds(self):
        listed = fx("--help")
        self.assertEqual(listed.code, 0)
        for name in ("render", "validate", "doctor", "parameters", "grid"):
            self.assertIn(name, listed.out)
            self.assertEqual(fx(name, "--help").code, 0)
        for option in ("--size", "--time", "--frames", "--fps", "--quality", "--seed", "--stats", "--renderer", "--json"):
            self.assertIn(option, fx("render", "--help").out)

    def test_a_command_line_that_makes_no_sense_is_exit_code_2(self):
        preset = LIBRARY / "sparks.fx.json"
        out = self.folder / "a.png"
        for arguments in ([], ["paint"], ["render"], ["render", preset], ["validate"], ["doctor", "--unknown"],
                          ["render", preset, "-o", out, "--size", "0x10"], ["render", preset, "-o", out, "--size", "10"],
                          ["render", preset, "-o", out, "--size", "99999x10"], ["render", preset, "-o", "a.jpg"],
                          ["render", preset, "-o", out, "--frames", "0:3"], ["render", preset, "-o", out, "--time", "-1"],
                          ["render", preset, "-o", out, "--time", "nan"], ["render", preset, "-o", out, "--seed", "-1"], ["render", preset, "-o", out, "--quality", "best"],
                          ["render", preset, "-o", self.folder / "a.%d.png", "--frames", "5:3"],
                          ["render", preset, "-o", self.folder / "a.%d.png", "--frames", "0:99999999"],
                          ["render", preset, "-o", out, "--renderer", "vulkan"]):
            outcome = fx(*arguments)
            self.assertEqual(outcome.code, 2, arguments)
            self.assertTrue(outcome.err.strip(), arguments)
        self.assertEqual(self.names(), [])

    def test_what_cannot_be_done_is_exit_code_1_and_names_the_file(self):
        for name in ("missing.scene.json", "missing.fx.json", "library:missing"):
            outcome = fx("render", name, "-o", self.folder / "a.png")
            self.assertEqual(outcome.code, 1)
            self.assertIn("missing", outcome.err)
        outcome = fx("render", "library:sparks", "-o", self.folder / "missing" / "a.png")
        self.assertEqual(outcome.code, 1)
        self.assertIn("there is no folder", outcome.err)
        self.assertEqual(self.names(), [])

    def test_list_names_the_presets_of_the_library(self):
        names = {path.name.removesuffix(".fx.json") for path in LIBRARY.glob("*.fx.json")}
        listed = [json.loads(line) for line in fx("list", "--json").out.splitlines()]
        self.assertEqual({preset["name"] for preset in listed}, names)
        for preset in listed:
            self.assertEqual(preset["description"], json.loads((LIBRARY / f"{preset['name']}.fx.json").read_text())["description"])
        self.assertEqual(len(fx("list").out.splitlines()), len(names))
        found = fx("list", "CAMPfire").out
        self.assertEqual(found, "campfire  Wood fire of about 1 m\n")
        outcome = fx("list", "teapot")
        self.assertEqual((outcome.code, outcome.out), (1, ""))
        self.assertIn("teapot", outcome.err)

    def test_doctor_reports_the_machine_as_text_and_as_one_object(self):
        text = fx("doctor")
        self.assertIn("OpenGL 4.5", text.out)
        report = json.loads(fx("doctor", "--json").out)
        self.assertGreaterEqual(report["machine"]["cores"], 1)
        self.assertTrue(report["version"])
        for check in report["checks"]:
            self.assertTrue(check["ok"] or check["remedy"], check)
        required = [check["ok"] for check in report["checks"] if check["required"]]
        self.assertEqual(text.code, 0 if all(required) else 1)

    def test_doctor_says_what_to_install_when_ffmpeg_is_missing(self):
        outcome = fx("doctor", env={"PATH": str(self.folder)})
        self.assertIn("apt-get install ffmpeg", outcome.out)

    def test_the_parameter_reference_names_units_and_defaults(self):
        outcome = fx("parameters")
        self.assertEqual(outcome.code, 0)
        for word in ("unit", "default", "K", "radius"):
            self.assertIn(word, outcome.out)

    def test_parts_of_the_reference_and_the_schema_are_printed_alone(self):
        forces = fx("parameters", "emitters[]/forces/vortices")
        self.assertEqual(forces.code, 0)
        self.assertIn("`hold`", forces.out)
        self.assertNotIn("maxParticles", forces.out)
        self.assertEqual(fx("parameters", "emiters").code, 1)
        for kind, member in (("preset", "emitters"), ("scene", "camera")):
            self.assertIn(member, json.loads(fx("parameters", "--json-schema", kind).out)["properties"])
        self.assertEqual(fx("parameters", "--json-schema", "picture").code, 2)

    def test_parameters_are_found_by_heading_member_and_description(self):
        def lines(word):
            found = fx("parameters", word)
            self.assertEqual(found.code, 0, word)
            return [line for line in found.out.splitlines() if line]

        by_name = lines("shutter")
        self.assertTrue(any(line.startswith("| `shutter` |") for line in by_name))
        self.assertFalse(any(line.startswith("| `maxParticles` |") for line in by_name))
        for line in by_name: # nothing but members that contain the word, each below its section's heading
            self.assertTrue(line.startswith(("## ", "| member", "|---")) or "shutter" in line.lower(), line)
        self.assertTrue(any(line.startswith("| `shutter` |") for line in lines("exposure time"))) # of its description
        self.assertEqual(by_name, lines("SHUTTER"))
        missing = fx("parameters", "shuter")
        self.assertEqual((missing.code, missing.out), (1, ""))
        self.assertIn("did you mean \"shutter\"?", missing.err)

    def test_a_mistyped_name_gets_the_nearest_one(self):
        out = self.folder / "a.png"
        for arguments, meant in ((["rendr"], "render"), (["render", "library:campfire", "-o", out, "--siz", "9x9"], "--size"),
                                 (["render", "library:campfire", "--ouput=a.png"], "--output"),
                                 (["render", "library:campfire", "-o", out, "--quality", "hihg"], "high"),
                                 (["bench", "partcles"], "particles"), (["bench", "sort", "--variant", "randm"], "random"),
                                 (["bench", "sort", "--stps", "2"], "--steps"), (["accuracy", "furnce"], "furnace"),
                                 (["verify", "sedv"], "sedov"), (["parameters", "--json-schema", "presett"], "preset"),
                                 (["stability", "R-010", "-o", self.folder], "R-01"),
                                 (["calibrate", "-o", self.folder / "c.json", "--clock", "wal"], "wall")):
            outcome = fx(*arguments)
            self.assertEqual(outcome.code, 2, arguments)
            self.assertIn(f"did you mean \"{meant}\"?", outcome.err, arguments)
        outcome = fx("render", "library:campfir", "-o", out)
        self.assertEqual(outcome.code, 1)
        self.assertIn("did you mean \"campfire\"?", outcome.err)
        self.assertEqual(self.names(), [])

    def test_explain_names_the_techniques_whose_members_are_in_use(self):
        emitter = {"maxParticles": 50, "emission": {"rate": 20}, "appearance": {"kind": "sprite"}}
        for more, wanted in (({}, {"sprites and meshes"}),
                             ({"appearance": {"kind": "medium"}}, {"spherical billboards"}),
                             ({"speed": 1, "trail": {"lifetime": 1}, "light": {"intensity": 1}},
                              {"sprites and meshes", "ribbons", "particle lights"})):
            path = self.write("a.fx.json", json.dumps({"version": 1, "emitters": [emitter | more]}))
            outcome = fx("explain", path, "--json", "--size", 64)
            self.assertEqual(outcome.code, 0, outcome.err)
            report = json.loads(outcome.out)
            found = {entry["technique"] for entry in report["techniques"] if entry["exists"]}
            self.assertEqual(found - {"emitters", "dazzle"}, wanted)
            self.assertGreater(report["emitters"][0]["bytes"], 50 * 16)

    def test_explain_lists_the_lights_of_media_and_what_their_planes_take(self):
        outcome = fx("explain", "library:campfire", "--time", 2, "--json", "--size", 64)
        self.assertEqual(outcome.code, 0, outcome.err)
        lights = json.loads(outcome.out)["lights"]
        self.assertEqual(lights[0]["light"], "sun")
        self.assertIn("effect", {entry["light"] for entry in lights})
        for entry in lights:
            self.assertEqual(entry["casts_shadows"], entry["bytes"] > 0, entry)
            self.assertEqual(entry["casts_shadows"], entry["rays"] > 0, entry)
            self.assertEqual(entry["casts_shadows"], entry["ms"] > 0, entry)
        sun, sky = lights[0], lights[-1]
        self.assertAlmostEqual(sun["ms"] / sky["ms"], sun["rays"] / sky["rays"], delta=1e-3 * sun["rays"] / sky["rays"])
        outcome = fx("explain", "library:campfire", "--time", 2, "--size", 64)
        self.assertIn("sun 0: media cast shadows", outcome.out)

    def test_explain_says_how_light_is_scattered_again_and_why(self):
        smoke = {"version": 1, "emitters": [{"emission": {"rate": 20}, "radius": 0.5, "crossSection": 0.3, "albedoOverLife": [0.9, 0.9, 0.9],
                                             "appearance": {"kind": "medium"}}]}
        network = smoke | {"composition": "volume", "scattering": "network"}
        self.write("smoke.fx.json", json.dumps(smoke))
        self.write("network.fx.json", json.dumps(network))
        def only(**members):
            return network | {"emitters": [smoke["emitters"][0] | members]}

        sparks = {"version": 1, "emitters": [{"emission": {"rate": 20}, "appearance": {"kind": "sprite"}}]}
        scene = {"version": 1, "camera": {"position": [0, 1, 9], "target": [0, 1, 0]}, "composition": "automatic",
                 "instances": [{"preset": "smoke.fx.json"}, {"preset": "network.fx.json"}]}

        def explained(name, content, size=64):
            outcome = fx("explain", self.write(name, json.dumps(content)), "--json", "--size", size)
            self.assertEqual(outcome.code, 0, outcome.err)
            return [(entry["asks"], entry["gets"], entry["why"]) for entry in json.loads(outcome.out)["scattering"]]

        self.assertEqual(explained("a.fx.json", sparks), [])
        self.assertEqual(explained("a.fx.json", smoke), [("automatic", "closed_form", "no preset asks for another")])
        self.assertEqual(explained("a.fx.json", smoke | {"scattering": "single"})[0][:2], ("single", "single"))
        self.assertEqual(explained("a.fx.json", network)[0][:2], ("network", "network"))
        for medium, why in ((only(crossSection=0.001), "optical depth"), (only(albedoOverLife=[0.1, 0.1, 0.1]), "albedo 0.1 is below 0.3")):
            asks, gets, reason = explained("a.fx.json", medium)[0]
            self.assertEqual((asks, gets), ("network", "closed_form"))
            self.assertIn(why, reason)
        between = explained("a.fx.json", only(albedoOverLife=[0.27, 0.27, 0.27]))[0]
        self.assertEqual(between[1], "closed_form")
        self.assertIn("keeps it down to 80 % of the limit", between[2])
        for name in "bcdef": # as many as a picture may have, and one that is farther away
            self.write(f"{name}.fx.json", json.dumps(network))
        places = [{"preset": f"{name}.fx.json", "position": [8 * i, 0, 0 if name != "d" else -12]} for i, name in enumerate("bcdef")]
        many = explained("s.scene.json", scene | {"scattering": "automatic", "instances": places,
                                                  "camera": {"position": [16, 1, 40], "target": [16, 1, 0]}}, 1080)
        self.assertEqual([gets for _, gets, _ in many], ["network", "network", "closed_form", "network", "network"])
        self.assertIn("4 media with networks are larger on the picture", many[2][2])
        self.assertEqual(explained("a.fx.json", smoke | {"scattering": "network"})[0][1:],
                         ("closed_form", "networks need the composition volume or slabs"))
        for setting, gets, why in ((None, "closed_form", "the scene says so"), ("off", "single", "the scene says so"),
                                   ("automatic", "network", "network.fx.json asks for it")):
            more = {} if setting is None else {"scattering": setting}
            for (_, got, reason), asked in zip(explained("s.scene.json", scene | more), ("automatic", "network"), strict=True):
                self.assertEqual(got, gets, asked)
                self.assertEqual(reason.split(";")[0], why, asked)

    def test_a_full_disk_behind_standard_output_is_a_failure(self):
        for arguments in (["doctor"], ["parameters"], ["validate", LIBRARY / "sparks.fx.json"]):
            with open("/dev/full", "wb") as full:
                outcome = fx(*arguments, stdout=full)
            self.assertEqual(outcome.code, 1, arguments)
            self.assertIn("standard output", outcome.err)


if __name__ == "__main__":
    unittest.main()
