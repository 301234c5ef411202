"""The commands that documents show: finds them, and makes them small enough to be run in a test.

A command is a line of a fenced block of shell text (```sh), a line of another block that begins as a command does, or
`fx ...` between backquotes in a text. It is one of three kinds:

run       as it is written, at a small size
synopsis  with placeholders (FILE), choices (a|b) and optional parts ([--size N]): run with what is not optional, for each
          choice; the options in the optional parts must be known
mention   a subcommand, perhaps with options, without what it cannot do without: its options must be known
"""
import dataclasses
import itertools
import re
import shlex

REMARK = re.compile(r"\([^()]*\)")
OPTIONAL = re.compile(r"\[[^\[\]]*\]")
PLACEHOLDER = re.compile(r"^[A-Z]{2,}[A-Z.]*(\.\w+)?$|^[A-Z]$")
STARTS = ("fx ", "printf ", "for ", "build/", "./", "scripts/", "cmake ", "ctest ")  # of commands in other blocks


@dataclasses.dataclass(frozen=True)
class Command:
    place: str  # file:line
    text: str   # one line
    kind: str   # run, synopsis or mention


def logical_lines(numbered):
    """Joins lines that end with a backslash, loops, and lines below a synopsis that go on with an optional part."""
    joined = []
    for number, line in numbered:
        if joined and joined[-1][1].startswith("for ") and not joined[-1][1].endswith("\ndone"):
            joined[-1] = (joined[-1][0], joined[-1][1] + "\n" + line.strip())
        elif joined and (joined[-1][1].endswith("\\") or re.match(r"\s{8,}[\[(]", line)):
            joined[-1] = (joined[-1][0], joined[-1][1].rstrip("\\").rstrip() + " " + line.strip())
        else:
            joined.append((number, line.rstrip()))
    return joined


def blocks(text):
    """(language, [(number, line)]) of fenced blocks, and of indented ones, whose language is None."""
    fence, indented, before = None, [], ""
    for number, line in enumerate(text.split("\n"), 1):
        if line.lstrip().startswith("```"):
            if fence is None:
                fence = (line.strip().strip("`"), [])
            else:
                yield fence
                fence = None
        elif fence is not None:
            fence[1].append((number, line))
        elif line.startswith("    ") and (indented or not before.strip()):
            indented.append((number, line[4:]))
        elif indented and line.strip():
            yield None, indented
            indented = []
        before = line
    if indented:
        yield None, indented


def words_of(text):
    return shlex.split(text, comments=True)


def is_synopsis(words):
    return any(PLACEHOLDER.match(word) or word.startswith("[") or word.endswith(("]", "...")) or
               re.match(r"^[\w-]+(\|[\w-]+)+$", word) or word == "library:NAME" for word in words)


def is_complete(words, needs):
    """Whether `fx ...` names what its subcommand cannot do without."""
    subcommand = words[1] if len(words) > 1 else ""
    rest = words[2:]
    if subcommand not in needs:
        return bool(rest) or subcommand in ("doctor", "parameters", "--help")
    return any(word in needs[subcommand] for word in rest) or \
        ("POSITIONAL" in needs[subcommand] and bool(rest) and not rest[0].startswith("-"))


def commands_in(text, name, needs):
    """All commands of a document. @param needs by subcommand: options one of which it needs, or POSITIONAL"""
    found = []

    def add(number, line, may_be_mention):
        words = [] if line.startswith("#") else words_of(line)
        if not words:
            return
        kind = "run"
        if words[0] == "fx":
            kind = "synopsis" if is_synopsis(words) else "run"
            if may_be_mention and not is_complete(words, needs):
                kind = "mention"
        found.append(Command(f"{name}:{number}", line, kind))

    for language, lines in blocks(text):
        for number, line in logical_lines(lines):
            if language in ("sh", "bash") or (language in (None, "") and line.startswith(STARTS)):
                add(number, line, False)
    code = set()
    for _, lines in blocks(text):
        code.update(number for number, _ in lines)
    for number, line in enumerate(text.split("\n"), 1):
        if number not in code:
            for span in re.findall(r"`(fx [^`]+)`", line):
                add(number, span.replace("\\|", "|"), True)
    return found


def files_in(text):
    """(name, content) of the files that a document has a shell write."""
    return re.findall(r"^cat > (\S+) <<END\n(.*?)^END$", text, re.MULTILINE | re.DOTALL)


def options_in(text):
    """Long and short options that a synopsis or a mention names."""
    return sorted(set(re.findall(r"(?<![\w-])--?[a-z][\w-]*", text)))


def alternatives(synopsis, values):
    """The command lines that a synopsis stands for without its optional parts, as lists of words.

    @param values by placeholder: what to put in its place; a list stands for several words
    """
    text = REMARK.sub("", synopsis)
    while OPTIONAL.search(text):
        text = OPTIONAL.sub("", text)
    choices = []
    for word in words_of(text):
        word = word.removesuffix("...")
        if word in values:
            value = values[word]
            choices.append([value if isinstance(value, list) else [value]])
        elif PLACEHOLDER.match(word) or word == "library:NAME":
            raise KeyError(f"no value for the placeholder {word}")
        else:
            choices.append([[part] for part in word.split("|")])
    return [list(itertools.chain.from_iterable(picked)) for picked in itertools.product(*choices)]


@dataclasses.dataclass(frozen=True)
class Small:
    """How a command becomes small: for those that begin with `words`."""
    words: tuple
    options: dict = dataclasses.field(default_factory=dict)  # set, whether they are there or not; None: a flag
    present: dict = dataclasses.field(default_factory=dict)  # set where they are there
    absent: dict = dataclasses.field(default_factory=dict)   # set where they are not
    dropped: tuple = ()                                      # flags left out
    named: str = None                                        # argument set where there is none without an option


FEW = {"--count": "1000", "--steps": "1"}
HAVE_SMALL = ("paper-frame", "billboards", "layer-scale", "slices", "network-frame", "neighbor-search", "pair-loops", "explosion", "ray-integral", "network", "trace",
              "reference", "parallel-loop", "work-units")  # an option for it
# Verdicts of --check hold for full sizes only; tests of their own ask for them (CMakeLists.txt, test_fx_*.py).
SMALL = (
    Small(("fx", "render"), {"--size": "48x32"}, {"--frames": "0:1", "--time": "0.1"}),
    Small(("fx", "gallery"), {"--size": "48x32", "--times": "1"}, named="sparks"),
    Small(("fx", "edit"), present={"--measure": "2"}, absent={"--width": "640", "--height": "480"}),
    Small(("fx", "export"), {"--quality": "low"}, {"--frames": "0:1", "--time": "0.1", "--voxel-size": "0.5"}, {"--voxels": "100000"}),
    Small(("fx", "bench", "particles"), FEW),
    Small(("fx", "bench", "many-small"), FEW),
    Small(("fx", "bench", "sort"), FEW),
    Small(("fx", "bench", "emit"), FEW),
    Small(("fx", "bench", "frame"), FEW),
    *(Small(("fx", "bench", name), {"--small": None}) for name in HAVE_SMALL),
    *(Small(("fx", "bench", name), {"--small": None}, {"--size": "64x36"}) for name in ("composition", "lit-frame")),
    Small(("fx", "bench", "blocks"), {"--small": None, "--repeat": "1"}, {"--size": "64x36", "--count": "20000"}, {"--count": "20000"}),
    Small(("fx", "bench", "detail"), {"--small": None, "--repeat": "1"}),
    Small(("fx", "explain"), {"--size": "32"}),
    Small(("fx", "bench", "--plot"), {"--most": "1000"}),
    Small(("fx", "bench", "city"), {"--instances": "100", "--frames": "2"}, dropped=("--check",)),
    Small(("fx", "bench", "lod"), {"--instances": "2", "--size": "64", "--repeats": "1", "--flight": "2"}, dropped=("--check",)),
    Small(("fx", "bench", "budget"), {"--frames": "2", "--size": "16x16", "--budget": "5"}, dropped=("--check",)),
    # of all techniques: test_fx_budget.py
    Small(("fx", "calibrate"), {"--size": "16x16", "--repeat": "1"}, absent={"-o": "my-gpu.json", "--technique": "shimmer"}),
    Small(("fx", "verify"), {"--particles": "512", "--time": "0.001"}),
    *(Small(("fx", "accuracy", technique), {"--repeat": "1", "--no-callgrind": None}, absent={"--scene": scene})
      for technique, scene in (("ray-integral", "tau-0.1"), ("furnace", "float"), ("billboards", "isolated-1"),
                               ("dazzle", "gray"), ("light-slices", "parallel-tau-1"), ("outputs", "ball"))),
    Small(("fx", "accuracy", "detail"), {"--repeat": "1", "--no-callgrind": None, "--scene": "explosion-0.6-small"}),
    Small(("fx", "accuracy", "grid"), {"--repeat": "1", "--no-callgrind": None, "--scene": "tau-5-small"}),
    Small(("fx", "accuracy", "impostors"), {"--repeat": "1", "--no-callgrind": None, "--scene": "size-48-small"}, {"--cases": "1"}),
    Small(("fx", "accuracy", "network"), {"--repeat": "1", "--no-callgrind": None, "--scene": "side-5-small"}),
    Small(("fx", "stability"), {"--quick": None}),
)


def set_option(words, option, value, only_present=False):
    """`words` with the option set, in the form --option VALUE or --option=VALUE that is there already."""
    for i, word in enumerate(words):
        if word == option and value is not None:
            return words[: i + 1] + [value] + words[i + 2:]
        if word.startswith(option + "="):
            return words[:i] + [f"{option}={value}"] + words[i + 1:]
        if word == option:
            return words
    if only_present:
        return words
    return words + ([option] if value is None else [option, value])


def made_small(words):
    """By the longest rule that fits. Small ones stay as they are."""
    program = words[0].rpartition("/")[2]
    fitting = [rule for rule in SMALL if (program, *words[1: len(rule.words)]) == rule.words]
    if not fitting:
        return words
    rule = max(fitting, key=lambda rule: len(rule.words))
    words = [word for word in words if word not in rule.dropped]
    options = [i for i, word in enumerate(words) if word.startswith("-")]
    if rule.named and all(i in options or i - 1 in options for i in range(len(rule.words), len(words))):
        words = [*rule.words, rule.named, *words[len(rule.words):]]
    for option, value in rule.absent.items():
        if not any(word == option or word.startswith(option + "=") for word in words):
            words = [*rule.words, option, value, *words[len(rule.words):]]
    for option, value in rule.options.items():
        words = set_option(words, option, value)
    for option, value in rule.present.items():
        words = set_option(words, option, value, only_present=True)
    return words
