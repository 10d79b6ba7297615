# Sourced by tools/firn and tools/test: configure and build with a preset, quietly. Needs $root, the source folder.
# Nothing is printed on stdout, which belongs to the program that is built.
# shellcheck shell=bash

# build PRESET TARGET...: does nothing quickly when nothing changed. Calls at the same time wait for each other.
build() {
  local preset=$1 folder=${root:?}/build/$1
  shift
  mkdir -p "$folder"
  (
    flock 9
    build_locked "$preset" "$folder" "$@" 9>&-
  ) 9>"$folder/.lock"
}

build_locked() {
  local preset=$1 folder=$2 first=false log=$2/build.log
  shift 2
  if [[ ! -e $folder/.built ]]; then
    first=true
    echo "firn: building the '$preset' preset for the first time; this takes some minutes" >&2
  fi
  if [[ ! -e $folder/build.ninja ]]; then
    (cd "$root" && cmake --preset "$preset") >"$log" 2>&1 </dev/null || build_failed "$log"
  fi
  if $first && [[ -t 2 ]]; then
    ninja -C "$folder" "$@" >&2 </dev/null || build_failed /dev/null
  else
    ninja --quiet -C "$folder" "$@" >"$log" 2>&1 </dev/null || build_failed "$log"
  fi
  touch "$folder/.built"
}

build_failed() {
  cat "$1" >&2
  echo "firn: the build failed; its messages are above" >&2
  exit 3
}
