#!/usr/bin/env python3
"""docs/howto/errors.md lists the results of the C API, and messages that fx validate prints."""
import json
import re
import unittest

from fx_program import ROOT, FxTest, fx


def emitter(**members):
    return {"name": "a", "emission": {"rate": 5}, **members}


def preset(*emitters, **members):
    return {"version": 1, "name": "p", **members, "emitters": list(emitters) or [emitter()]}


def sprite(**members):
    return emitter(appearance={"kind": "sprite", **members})


FAULTS = [
    preset(emitter(litetime=1)),
    preset(emitter(kilograms=1)),
    preset(emitter(detail={"billowSize": 1})),
    preset(emitter(lifetime=-1)),
    preset(sprite(texture="library:smok.png")),
    {**preset(), "version": 99},
]
WARNED = [
    {"version": 1, "name": "p", "emitters": []},
    {**preset(), "version": 0},
    preset(emitter(forces={"curlStrength": 1})),
    preset(emitter(forces={"vortices": [{"radius": 1, "speed": 1}]})),
    preset(wind=[1, 0, 0]),
    preset(emitter(forces={"updraft": 1, "drag": 1})),
    preset(emitter(forces={"friction": 1})),
    preset(emitter(forces={"bounce": 0.5}, collisions=[{"shape": "ground"}])),
    preset(emitter(collisions=[{"shape": "ground"}]), ground=False),
    preset(emitter(collisions=[{"shape": "sphere", "size": 0}])),
    preset(emitter(collisions=[{"shape": "depth"}])),
    preset(emitter(events=[{"on": "collision", "emit": "b"}]), {"name": "b"}),
    preset(emitter(compute="gpu", trail={"lifetime": 1})),
    preset(emitter(maxParticles=1, emission={"rate": 1000})),
    preset(emitter(shape="sphere", angleDegrees=10)),
    preset({**sprite(), "opticalDepth": 1}),
    preset(emitter(shape="spline", points=[[0, 0, 0], [0, 0, 0]])),
    preset(sprite(motion="library:smoke-motion.png")),
    preset(sprite(frames="per-second")),
    preset(sprite(frames="per-second", texture="library:smoke.png", tileColumns=2)),
    preset(sprite(stretch=0.1)),
    preset(emitter(light={})),
    preset(emitter(light={}, appearance={"kind": "sprite", "luminance": 0})),
    preset(emitter(appearance={"kind": "none"})),
    preset(sprite(), scattering="network"),
    preset(scattering="network"),
    preset(sprite(order="oldest"), composition="volume"),
    preset(emitter(detailAmount=1, detail={"material": "smoke", "billowSize": 0.1}), composition="volume"),
    preset(emitter(detailAmount=1, detail={"material": "smoke", "liveliness": 10}), composition="volume"),
    preset(emitter(maxParticles=10000000, emission={"rate": 1e6}, lifetime=10)),
    preset(emitter(maxParticles=1000000, emission={"rate": 1e6}, lifetime=1, forces={"drag": 1, "curlStrength": 1}), prewarm=600),
]


class ErrorsPage(FxTest):
    def setUp(self):
        super().setUp()
        self.page = (ROOT / "docs" / "howto" / "errors.md").read_text(encoding="utf-8")

    def rows(self, heading):
        section = self.page.split(f"\n## {heading}\n")[1].split("\n## ")[0]
        return re.findall(r"^\| `(.*?)` \|", section, re.MULTILINE)

    def check(self, heading, documents, severity):
        rows = {row: re.compile(".*".join(map(re.escape, row.split("…"))) + "$") for row in self.rows(heading)}
        seen = set()
        for number, document in enumerate(documents):
            file = self.write(f"{number}.fx.json", json.dumps(document))
            findings = json.loads(fx("validate", file, "--json").out)["diagnostics"]
            messages = [finding["message"] for finding in findings if finding["severity"] == severity]
            self.assertTrue(messages, document)
            for message in messages:
                matching = [row for row, pattern in rows.items() if pattern.match(message)]
                self.assertTrue(matching, f"{message!r} of {document} is not in the section {heading!r}")
                seen.update(matching)
        self.assertEqual(sorted(rows.keys() - seen), [], "no preset of this test has these messages")

    def test_warnings_of_presets_are_those_that_validate_prints(self):
        self.check("Warnings of presets", WARNED, "warning")

    def test_errors_of_files_are_those_that_validate_prints(self):
        self.check("Errors of files", FAULTS, "error")

    def test_all_results_of_the_c_api_are_listed(self):
        header = (ROOT / "fxsdk" / "include" / "fxsdk" / "fx_base.h").read_text(encoding="utf-8")
        self.assertEqual(self.rows("Results of functions"), re.findall(r"^    (FX_ERROR_\w+)", header, re.MULTILINE))


if __name__ == "__main__":
    unittest.main()
