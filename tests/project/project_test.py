"""What the project says of itself, against itself. Needs nothing but Python's own library."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(os.environ["KINEMESH_SOURCE_DIR"])
PROGRAM = os.environ["KINEMESH_PROGRAM"]

FOLDERS = ("core", "motion", "untangle", "sim", "c")
# On top of the rooms: what includes from all of them.
PROGRAMS = ("sim/cli", "c")


def read(path):
    return path.read_text(encoding="utf-8")


def sources(folder):
    return [path for path in sorted((ROOT / folder).rglob("*")) if path.suffix in (".h", ".cpp")]


def pages():
    return sorted((ROOT / "docs").glob("*.md")) + [ROOT / "README.md", ROOT / "CONTRIBUTING.md"]


def written(*suffixes):
    """All files of ours with these ends of their names."""
    folders = (*FOLDERS, "include", "tests", "bench", "examples", "cmake", "scripts")
    paths = [*ROOT.iterdir(), *(path for folder in folders for path in sorted((ROOT / folder).rglob("*")))]
    return [path for path in paths
            if path.name.endswith(suffixes) and path.is_file() and "node_modules" not in path.parts]


def rooms():
    """{folder: {"SOURCES": [...], "HEADERS": [...], "KNOWS": [...], "USES": [...]}}, by CMakeLists.txt."""
    found = {}
    for folder in FOLDERS:
        for lists in sorted((ROOT / folder).rglob("CMakeLists.txt")):
            for body in re.findall(r"kinemesh_room\(([^)]*)\)", re.sub(r"#.*|\$\{\w+\}", "", read(lists))):
                room, *words = body.split()
                lines, key = {"SOURCES": [], "HEADERS": [], "KNOWS": [], "USES": []}, ""
                for word in words:
                    key = word if word in lines else key
                    if word not in lines:
                        lines[key].append(word)
                found[room] = lines
    return found


def blocks(document, language):
    return re.findall(rf"^```{language}\n(.*?)^```$", read(ROOT / document), re.MULTILINE | re.DOTALL)


def run(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False)


class Rooms(unittest.TestCase):
    """docs/architecture.md: a room includes from itself, and from the rooms it says it knows."""

    def setUp(self):
        self.rooms = rooms()
        self.assertGreater(len(self.rooms), 15)
        self.room_of = {f"kinemesh/{name}.h": room
                        for room, lines in self.rooms.items() for name in lines["HEADERS"]}

    def headers(self, room):
        return [ROOT / "include/kinemesh" / f"{name}.h" for name in self.rooms[room]["HEADERS"]]

    def files(self, room):
        inside = [path for path in sorted((ROOT / room).iterdir()) if path.suffix in (".h", ".cpp")]
        return inside + self.headers(room)

    def included(self, path):
        """From which room, by the name in the #include."""
        for name in re.findall(r'^\s*#\s*include\s*"([^"]+)"', read(path), re.MULTILINE):
            yield name, self.room_of.get(name, os.path.dirname(name))

    def test_each_includes_from_whom_it_knows(self):
        for room, lines in self.rooms.items():
            used = set()
            for path in self.files(room):
                for name, other in self.included(path):
                    if other != room:
                        self.assertIn(other, lines["KNOWS"], f"{path.relative_to(ROOT)} includes {name}")
                        used.add(other)
            self.assertEqual(set(lines["KNOWS"]) - used, set(), f"{room} need not know them")

    def test_each_source_has_its_room(self):
        for folder in FOLDERS:
            for path in sources(folder):
                place = str(path.parent.relative_to(ROOT))
                if place not in PROGRAMS:
                    self.assertTrue(place in self.rooms, place)
                    if path.suffix == ".cpp":
                        self.assertIn(path.stem, self.rooms[place]["SOURCES"])

    def test_each_public_header_has_its_room(self):
        for path in sources("include/kinemesh"):
            name = str(path.relative_to(ROOT / "include"))
            if name != "kinemesh/kinemesh.h":  # of all rooms
                self.assertIn(name, self.room_of)

    def test_cgal_stays_behind_sources(self):
        headers = {path: read(path)
                   for folder in (*FOLDERS, "include") for path in sources(folder) if path.suffix == ".h"}
        internal = {path for path, text in headers.items() if "For .cpp files only" in text}
        for path in headers.keys() - internal:
            self.assertNotIn("#include <CGAL/", headers[path], path)
            for name in internal:
                self.assertFalse(f'"{name.relative_to(ROOT)}"' in headers[path], f"{path} includes {name}")


class References(unittest.TestCase):
    """[Author 1999, §2; Other & Third 2001] in a comment or a page is author1999 and other2001 in
    docs/references.bib."""

    PART = r"[A-Z][A-Za-z]+(?: & [\w ]+?)? [12]\d{3}(?:, [^\[\];]*)?"

    def setUp(self):
        self.entries = set(re.findall(r"^@\w+\{(\w+),", read(ROOT / "docs/references.bib"), re.MULTILINE))
        files = [path for folder in (*FOLDERS, "include", "tests", "bench") for path in sources(folder)]
        files += pages()
        self.cited = {}
        for path in files:
            text = re.sub(r"\s*\n\s*(?://)?\s*", " ", read(path))
            for citation in re.findall(rf"\[({self.PART}(?:; {self.PART})*)\]", text):
                for part in citation.split("; "):
                    key = part.split()[0].lower() + re.search(r"[12]\d{3}", part).group()
                    self.cited.setdefault(key, path.relative_to(ROOT))

    def test_each_key_has_an_entry(self):
        self.assertIn("agarwal2008", self.cited)
        for key, path in self.cited.items():
            self.assertIn(key, self.entries, f"cited in {path}")

    def test_each_entry_is_cited(self):
        self.assertEqual(self.entries - set(self.cited), set())


class Paths(unittest.TestCase):
    """A file that a comment or a page names by its path exists: from the root, include/ or its own folder."""

    NAME = re.compile(r"(?<![\w./~$<{*-])((?:[\w.-]+/)+[\w.-]+\.(?:h|cpp|md|py|sh))\b(?![\w*/])")

    def prose(self):
        for path in written(".h", ".cpp", ".c"):
            yield path, "\n".join(re.findall(r"//[^\n]*|/\*.*?\*/", read(path), re.DOTALL))
        for path in pages():
            yield path, read(path)

    def test_files_named_are_there(self):
        named = 0
        for path, text in self.prose():
            for name in self.NAME.findall(text):
                named += 1
                places = (ROOT / name, ROOT / "include" / name, path.parent / name)
                self.assertTrue(any(p.exists() for p in places), f"{path.relative_to(ROOT)} names {name}")
        self.assertGreater(named, 200)


class Columns(unittest.TestCase):
    def test_lines_have_110_columns_at_most(self):
        files = written(".h", ".cpp", ".c", ".py", ".cmake", "CMakeLists.txt", ".sh")
        self.assertGreater(len(files), 400)
        for path in files:
            for number, line in enumerate(read(path).splitlines(), 1):
                self.assertLessEqual(len(line), 110, f"{path.relative_to(ROOT)}:{number}")


class Format(unittest.TestCase):
    """.clang-format is the law, as the version of Debian 12 reads it: others format differently."""

    def test_clang_format_changes_nothing(self):
        command = ["clang-format", "--dry-run", "-Werror", *map(str, written(".h", ".cpp", ".c"))]
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr[:2000])


def has_clang_format():
    if not shutil.which("clang-format"):
        return False
    told = subprocess.run(["clang-format", "--version"], capture_output=True, text=True, check=False).stdout
    return "version 14." in told


class Names(unittest.TestCase):
    """Types are CamelCase, all else is snake_case; scripts/lint.sh asks for more, in half an hour."""

    TYPE = re.compile(r"^ *(?:class|struct|enum class|union) (\w+)(?: final)?\s*(?:[;{]|:(?!:))",
                      re.MULTILINE)
    FUNCTION = re.compile(
        r"^ *(?:\[\[nodiscard\]\] )?(?:(?:static|inline|constexpr|virtual|friend|explicit) )*"
        r"(?:\w[\w:]*(?:<[^;()]*>)?[&* ]+)(?:\w+::)*(\w+)\(", re.MULTILINE)
    STATEMENTS = {"return", "throw", "delete", "else", "case", "new", "dt"}
    OF_OTHERS = {"iterator", "Is_bad", "PrintTo", "SetUp", "TearDown"}  # std, CGAL, gtest

    def setUp(self):
        self.texts = {path: re.sub(r"//.*|/\*.*?\*/", "", read(path))
                      for path in written(".h", ".cpp") if path.name not in ("kinemesh.h", "plugin.h")}

    def test_of_files(self):
        for path in written(".h", ".cpp", ".c", ".py", ".sh", ".cmake"):
            self.assertRegex(path.name, r"^(?:[a-z][a-z0-9_]*|(?:Find|Kinemesh)[A-Z]\w+)\.\w+$")

    def test_of_types(self):
        seen = 0
        for path, text in self.texts.items():
            for name in self.TYPE.findall(text):
                seen += 1
                of_ours = re.fullmatch(r"(?:[A-Z][a-z0-9]*)+|kinemesh_\w+", name)
                self.assertTrue(of_ours or name in self.OF_OTHERS, f"{path}: {name}")
        self.assertGreater(seen, 400)

    def test_of_functions(self):
        types = {name for text in self.texts.values() for name in self.TYPE.findall(text)}
        seen = 0
        for path, text in self.texts.items():
            for match in self.FUNCTION.finditer(text):
                name = match[1]
                if match[0].split()[0] in self.STATEMENTS or name in types:
                    continue
                seen += 1
                of_ours = name.isupper() or re.fullmatch(r"[a-z][a-z0-9_]*", name)
                self.assertTrue(of_ours or name in self.OF_OTHERS, f"{path}: {name}")
        self.assertGreater(seen, 2000)

    def test_of_macros(self):
        for path, text in self.texts.items():
            for name in re.findall(r"^#define (\w+)", text, re.MULTILINE):
                self.assertRegex(name, r"^KINEMESH_|^BOOST_|^[A-Z_]+$", path)


class Readme(unittest.TestCase):
    def test_code_is_the_example_that_is_built_and_run(self):
        self.assertEqual(blocks("README.md", "cpp"), [read(ROOT / "examples/embed.cpp")])

    def test_links_lead_somewhere(self):
        for document in pages():
            text = re.sub(r"^```.*?^```$", "", read(document), flags=re.MULTILINE | re.DOTALL)
            for target in re.findall(r"\]\((?!https?:)([^)#]+)", text):
                self.assertTrue((document.parent / target).exists(), f"{document} links to {target}")


class Embedding(unittest.TestCase):
    """Each block of docs/embedding.md is a piece of a program that is built and run, apart from its
    indentation."""

    PROGRAMS = {"cpp": ("examples/solver_loop.cpp", "examples/fluid_structure.cpp",
                        "examples/openmesh_solver.cpp"),
                "c": ("tests/consumer/project/consumer.c", "examples/moving_walls.c"),
                "cmake": ("tests/consumer/project/CMakeLists.txt",)}

    def test_blocks_are_pieces_of_programs(self):
        for language, programs in self.PROGRAMS.items():
            lines = [line.strip() for program in programs for line in read(ROOT / program).splitlines()]
            shown = blocks("docs/embedding.md", language)
            self.assertGreater(len(shown), 0, language)
            for block in shown:
                wanted = [line.strip() for line in block.splitlines()]
                if language == "cmake":  # what stands between is the test's own business
                    self.assertLessEqual(set(wanted), set(lines), block)
                else:
                    starts = range(len(lines) - len(wanted) + 1)
                    is_there = any(lines[i:i + len(wanted)] == wanted for i in starts)
                    self.assertTrue(is_there, f"{programs}:\n{block}")


class Scenarios(unittest.TestCase):
    def test_documented_scenarios_are_accepted(self):
        documented = blocks("docs/scenarios.md", "toml") + blocks("README.md", "toml")
        self.assertGreater(len(documented), 1)
        for text in documented:
            with tempfile.TemporaryDirectory() as folder:
                scenario = Path(folder) / "scenario.toml"
                scenario.write_text(text, encoding="utf-8")
                result = run("run", scenario, "-o", Path(folder) / "out", "--dry-run")
                self.assertEqual(result.returncode, 0, result.stderr + text)

    def test_gallery_shows_the_scenarios_there_are(self):
        files = sorted((ROOT / "examples/gallery").glob("*.toml"))
        self.assertGreater(len(files), 1)
        page = read(ROOT / "docs/gallery.md")
        shown = sorted(set(re.findall(r"examples/gallery/([\w-]+\.toml)", page)))
        self.assertEqual(shown, [f.name for f in files])
        for scenario in files:
            with tempfile.TemporaryDirectory() as folder:
                result = run("run", scenario, "-o", Path(folder) / "out", "--dry-run")
                self.assertEqual(result.returncode, 0, result.stderr)

    def test_everything_the_program_lists_is_documented(self):
        listed = run("list")
        self.assertEqual(listed.returncode, 0, listed.stderr)
        pages = read(ROOT / "docs/scenarios.md") + read(ROOT / "docs/formats.md")
        names = re.findall(r"^ {2,4}([.\w-]+)(?: |$)", listed.stdout, re.MULTILINE)
        self.assertGreater(len(names), 20)
        for name in names:
            self.assertTrue(f"`{name}" in pages, f"{name} is not documented")


class CommandLine(unittest.TestCase):
    def test_readme_lists_exactly_the_commands_there_are(self):
        shown = run("--help").stdout.partition("Subcommands:")[2]
        commands = re.findall(r"^  ([a-z]+) ", shown, re.MULTILINE)
        self.assertGreater(len(commands), 3, shown)
        listed = re.findall(r"^\| `kinemesh ([a-z]+)", read(ROOT / "README.md"), re.MULTILINE)
        self.assertEqual(sorted(listed), sorted(commands))


if __name__ == "__main__":
    if "Format" in sys.argv and not has_clang_format():
        sys.exit(77)
    unittest.main()
