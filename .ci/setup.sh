# To be sourced by samples/run and tests/run: installs missing packages, builds a release. Quick if nothing is to be done.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build/release

install_packages() {
  command -v dpkg-query > /dev/null || {
    echo "no Debian or Ubuntu here: these packages are needed, under your system's names: $(packages)" >&2
    return 0
  }
  local here missing=()
  here=$(provided)
  for package in $(packages); do
    grep -qxF -- "$package" <<< "$here" || missing+=("$package")
  done
  [ ${#missing[@]} = 0 ] && return 0
  echo "installing ${missing[*]}"
  local as_root=()
  [ "$(id -u)" = 0 ] || as_root=(sudo)
  "${as_root[@]}" apt-get update -q
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "${missing[@]}"
}

# The names of the installed packages and of what they stand in for: another vendor's nodejs contains npm, and refuses it.
provided() {
  dpkg-query -W -f='${db:Status-Status} ${Package}, ${Provides}\n' | sed -n 's/^installed //p' | tr ',' '\n' |
    sed -e 's/(.*//' -e 's/[[:space:]]//g' -e '/^$/d' | sort -u
}

# extra: what one script needs besides. With tests=no those from "To test" on are left out.
packages() {
  sed -e "$([ "${tests:-}" != no ] || echo '/^# To test/,$d')" -e 's/#.*//' "$root/.ci/packages.txt" | tr '\n' ' '
  echo "${extra:-}"
}

# build_release [-DNAME=VALUE...]: the arguments go to the configuration. From nothing, rooms are compiled as one.
build_release() {
  local log=$root/build/configure.log
  [ -e "$build/CMakeCache.txt" ] || set -- -DBP_UNITY=ON "$@"
  mkdir -p "$root/build"
  cmake -S "$root" --preset release "$@" > "$log" 2>&1 || {
    cat "$log" >&2
    return 1
  }
  cmake --build "$build"
}
