# Sourced by tests/run and reports/certify: the packages of Debian 12 that Assay needs, and
# functions that install them and build.
# shellcheck shell=bash

assay_packages="g++ cmake ninja-build ccache libcgal-dev libgmp-dev libmpfr-dev libmpfi-dev
  libeigen3-dev libboost-dev libtbb-dev libgtest-dev librapidcheck-dev libcli11-dev libfmt-dev
  nlohmann-json3-dev libsqlite3-dev libseccomp-dev libssl-dev zlib1g-dev bubblewrap"

# Detectors of others that tests judge (corpus/peers); the program itself needs none of them.
# shellcheck disable=SC2034
assay_peer_packages="libfcl-dev libbullet-dev"

# For micro benches (tests/bench), which are left out without this package.
# shellcheck disable=SC2034
assay_bench_packages="libbenchmark-dev"

# For the Python module (reports/python) and its tests, which are left out without these packages.
# shellcheck disable=SC2034
assay_python_packages="python3 python3-dev pybind11-dev python3-numpy python3-meshio python3-pytest
  python3-pip python3-setuptools python3-venv python3-wheel"

# ensure_packages YES EXTRA...: installs the missing packages of assay_packages and EXTRA, or names
# them and stops. With YES=1 it does not ask first.
ensure_packages() {
  local yes=$1 missing=() package answer
  shift
  if ! command -v dpkg-query >/dev/null; then
    # shellcheck disable=SC2086
    echo "no dpkg-query here: cannot tell which of these are installed:" $assay_packages "$@" >&2
    return 2
  fi
  # shellcheck disable=SC2086
  for package in $assay_packages "$@"; do
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q '^install ok installed' ||
      missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return 0
  if ! command -v apt-get >/dev/null; then
    echo "missing, and there is no apt-get here to install them: ${missing[*]}" >&2
    return 2
  fi
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "missing, and neither root nor sudo is at hand: ${missing[*]}" >&2
      return 2
    fi
    as_root=(sudo)
  fi
  echo "will install with apt-get: ${missing[*]}"
  if [ "$yes" != 1 ]; then
    printf 'go on? [y/N] '
    read -r answer || answer=n
    case $answer in y | Y | yes) ;; *)
      echo "not installed; missing: ${missing[*]}" >&2
      return 2
      ;;
    esac
  fi
  local log
  log=$(mktemp)
  if ! "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -qq >"$log" 2>&1 ||
    ! "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
      apt-get install -y -qq --no-install-recommends "${missing[@]}" >>"$log" 2>&1; then
    tail -n 5 "$log" >&2
    rm -f "$log"
    echo "could not install: ${missing[*]}" >&2
    return 2
  fi
  rm -f "$log"
}

# show_build SECONDS: reads the lines of Ninja from its input and shows the progress of the build:
# on a terminal one line that is rewritten each second, elsewhere a line every SECONDS.
show_build() {
  local line step='' started=$SECONDS shown=$SECONDS between=$1
  [ ! -t 1 ] || between=1
  while :; do
    if IFS= read -r -t 1 line; then
      case $line in \[[0-9]*/[0-9]*\]\ *) step=${line#[} step=${step%%]*} ;; esac
    elif [ $? -le 128 ]; then
      break # the end of the input; more than 128 says that nothing came for a second
    fi
    [ $((SECONDS - shown)) -ge "$between" ] || continue
    shown=$SECONDS
    line="${step:+${step/\// of } steps, }$((shown - started)) s"
    if [ -t 1 ]; then printf '\r\033[K  %s' "$line"; else printf '  %s\n' "$line"; fi
  done
  [ ! -t 1 ] || printf '\r\033[K'
}

# build_preset PRESET TARGET...: configures build/PRESET and builds the targets. Shows only the
# progress, unless the build fails. A compile of the algebraic kernel takes 0.6 GB and more under a
# sanitizer.
build_preset() {
  local preset=$1 log started=$SECONDS
  shift
  log=build/$preset.log
  mkdir -p build
  echo "building build/$preset (log: $log)"
  if ! (
    set -o pipefail
    { cmake --preset "$preset" && cmake --build "build/$preset" --target "$@"; } 2>&1 |
      tee "$log" | show_build 30
  ); then
    grep -E 'error|Error|FAILED' "$log" | head -n 20 >&2
    echo "the build failed; see $log" >&2
    return 1
  fi
  echo "built in $((SECONDS - started)) s"
}
