#!/usr/bin/env bash
# run_fuzzer.sh TARGET FOLDER CORPUS WORDS LIBFUZZER-OPTION...
#
# Runs the fuzz target FOLDER/TARGET from its own seeds and the files of the folder CORPUS, with the dictionary WORDS;
# "-" stands for none. What it finds stays in FOLDER/TARGET.found. Inputs that take 2 GiB in all or 1 GiB at once are
# findings, and those that take five minutes, which only one without an end does, however busy the machine is.
set -euo pipefail
target=$1 folder=$2 corpus=$3 words=$4
shift 4

seeds=$folder/$target.seeds
found=$folder/$target.found
rm -rf "$seeds"
mkdir -p "$found"
"$folder/$target" "--write-seeds=$seeds"
if [ "$corpus" != - ]; then cp "$corpus"/* "$seeds"; fi
options=(-seed=1 -timeout=300 -rss_limit_mb=2048 -malloc_limit_mb=1024 -max_len=65536 -print_final_stats=1 "-artifact_prefix=$found/")
if [ "$words" != - ]; then options+=("-dict=$words"); fi
exec "$folder/$target" "${options[@]}" "$@" "$seeds"
