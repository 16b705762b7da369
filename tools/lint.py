#!/usr/bin/env python3
"""Runs clang-tidy over sources, as many at once as there are cores; exit code 1 when it complains about any.

A source that was clean is not read again until it, a header it includes, its flags, the configuration or clang-tidy itself changes: what it
came to is remembered in $XDG_CACHE_HOME/sheen-cts/lint (else ~/.cache) under a hash of all of these.
usage: lint.py BUILD_FOLDER SOURCE..."""

import concurrent.futures
import hashlib
import json
import os
import pathlib
import shlex
import subprocess
import sys

# The dearest checks of those that nothing here can trip: no C strings, no assert(), no macros that hold code, no C++98. They cost 40 % of the time.
OFF = (
    "-bugprone-reserved-identifier,-bugprone-stringview-nullptr,-bugprone-suspicious-string-compare,-bugprone-assert-side-effect,"
    "-bugprone-multiple-statement-macro,-bugprone-not-null-terminated-result,-bugprone-misplaced-widening-cast,"
    "-modernize-use-transparent-functors,-modernize-replace-auto-ptr,-modernize-deprecated-ios-base-aliases,-modernize-redundant-void-arg,"
    "-misc-misleading-identifier,-misc-static-assert,-readability-redundant-declaration,-performance-type-promotion-in-math-fn"
)
# Following every path through GoogleTest's macros takes longer than everything else together and is about GoogleTest.
OFF_IN_TESTS = ",-clang-analyzer-*"


def checks_of(source):
    return "--checks=" + OFF + (OFF_IN_TESTS if source.endswith("_test.cpp") else "")


def key_of(source, entry, common):
    """Hash of everything that the outcome depends on, or None when the source does not even preprocess."""
    command = shlex.split(entry["command"])
    flags = []
    skip = False
    for word in command[1:]:
        if skip or word in ("-c", "-o", entry["file"]):
            skip = word == "-o"
            continue
        flags.append(word)
    # -C keeps comments, where NOLINT may stand; -P drops line numbers and paths.
    done = subprocess.run(["g++", *flags, "-E", "-C", "-P", entry["file"]], cwd=entry["directory"], capture_output=True, check=False)
    if done.returncode != 0:
        return None
    plain_flags = " ".join(flag for flag in flags if not flag.startswith(("-I", "-D", "-isystem", "/")))
    return hashlib.sha256(b"\0".join([common, checks_of(source).encode(), plain_flags.encode(), done.stdout])).hexdigest()


def check(source, entry, build, common, memory):
    key = key_of(source, entry, common)
    if key and (memory / key).exists():
        return source, True, ""
    done = subprocess.run(["clang-tidy", "-p", build, "--quiet", checks_of(source), source], capture_output=True, text=True, check=False)
    if done.returncode == 0 and key:
        (memory / key).touch()
    return source, done.returncode == 0, done.stdout


def main():
    build, sources = sys.argv[1], sys.argv[2:]
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
        entries = {os.path.realpath(entry["file"]): entry for entry in json.load(file)}
    unknown = [source for source in sources if os.path.realpath(source) not in entries]
    if unknown:
        sys.exit("lint: in no target, so nothing would check it: " + " ".join(unknown))
    version = subprocess.run(["clang-tidy", "--version"], capture_output=True, check=True).stdout
    common = version + pathlib.Path(".clang-tidy").read_bytes()
    memory = pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache") / "sheen-cts" / "lint"
    memory.mkdir(parents=True, exist_ok=True)
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        jobs = [pool.submit(check, source, entries[os.path.realpath(source)], build, common, memory) for source in sources]
        for count, job in enumerate(concurrent.futures.as_completed(jobs), 1):
            source, clean, output = job.result()
            if not clean:
                failed += 1
                print(output, flush=True)
            if not clean or count % 20 == 0 or count == len(jobs):
                print(f"clang-tidy: {count}/{len(jobs)} {source}{'' if clean else ': complaints above'}", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
