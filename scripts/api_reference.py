#!/usr/bin/env python3
"""api_reference.py [FOLDER]: the API reference, by Doxygen from the public headers, as FOLDER/html/index.html
(default: build/api). Exit code 1 if Doxygen has anything to say. Needs Debian's package doxygen.

The headers are written for people: plain comments, before what they are about or behind it. Doxygen reads
them through this same program, which marks them for it (api_reference.py --mark HEADER)."""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

SETTINGS = {
    "PROJECT_NAME": "kinemesh",
    "PROJECT_BRIEF": '"Kinetic triangle meshes: move the vertices, untangle locally, go on"',
    "INPUT": f"{ROOT}/include/kinemesh.h {ROOT}/include/kinemesh",
    "FILE_PATTERNS": "*.h",
    "RECURSIVE": "YES",
    "EXCLUDE": f"{ROOT}/include/kinemesh/kinemesh.h",  # includes the others
    "EXCLUDE_SYMBOLS": "kinemesh::openmesh::*",
    "FULL_PATH_NAMES": "YES",
    "STRIP_FROM_PATH": f"{ROOT}/include",
    "STRIP_FROM_INC_PATH": f"{ROOT}/include",
    "FILTER_PATTERNS": f'"*.h={sys.executable} {__file__} --mark"',
    "FILTER_SOURCE_FILES": "NO",
    "EXTRACT_ALL": "YES",
    "EXTRACT_STATIC": "YES",
    "HIDE_FRIEND_COMPOUNDS": "YES",
    "JAVADOC_AUTOBRIEF": "YES",
    "AUTOLINK_SUPPORT": "YES",
    "SORT_MEMBER_DOCS": "NO",
    "GENERATE_LATEX": "NO",
    "HAVE_DOT": "NO",
    "QUIET": "YES",
    "WARN_AS_ERROR": "FAIL_ON_WARNINGS",
    "MACRO_EXPANSION": "YES",
    "EXPAND_ONLY_PREDEF": "YES",
    "PREDEFINED": "KINEMESH_API= __attribute__(x)=",
}


def escaped(text):
    """What Doxygen would take for an order of its own."""
    return re.sub(r"([\\@#<>%&])", r"\\\1", text)


def marked(name, lines):
    """Doxygen's marks for the comments of a C++ header."""
    behind = False  # the last line had a comment behind code: lines of comment alone go on with it
    is_first = True
    for line in lines:
        alone = re.match(r"^(\s*)//(?!/) ?(.*)$", line)
        trailing = None if alone else re.match(r"^(.*\S)\s+// (.*)$", line)
        if alone and behind and len(alone[1]) > 20:
            line = f"{alone[1]}///< {escaped(alone[2])}"
        elif alone:
            if is_first and not alone[1]:
                yield f"/// \\file {name}"
            line = f"{alone[1]}/// {escaped(alone[2])}"
            behind = False
        elif trailing and not trailing[1].startswith(("#", "}  //")) and not line.startswith("}"):
            line = f"{trailing[1]}  ///< {escaped(trailing[2])}"
            behind = True
        else:
            behind = False
        is_first = False
        yield line


def main():
    if sys.argv[1:2] == ["--mark"]:
        text = Path(sys.argv[2]).read_text(encoding="utf-8")
        # What is told to std is not ours to show.
        text = re.sub(r"template <class \w+>\nstruct std::.*?\n};\n", "", text, flags=re.DOTALL)
        is_c = text.startswith("/*")
        name = Path(sys.argv[2]).resolve().relative_to(ROOT / "include")
        print(re.sub(r"/\*(?!\*| -)", "/**", text) if is_c else "\n".join(marked(name, text.splitlines())))
        return 0
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/api")
    folder.mkdir(parents=True, exist_ok=True)
    settings = "\n".join(f"{key} = {value}"
                         for key, value in {**SETTINGS, "OUTPUT_DIRECTORY": folder}.items())
    result = subprocess.run(["doxygen", "-"], input=settings, text=True, check=False)
    if result.returncode == 0:
        print(folder / "html/index.html")
    return 1 if result.returncode else 0


if __name__ == "__main__":
    sys.exit(main())
