#!/usr/bin/env bash
# Tries the packages of a folder in the Debian in which it runs, as root: upgrades from an older version, does what README and the guides say,
# installs them over themselves, and removes them. Nothing may be left then. .ci/packages runs it in a fresh root.
#   tests/packages/in_root.sh FOLDER      with the packages, those of the older version in older/, run_guide.py, scenes.py and consumer/ of the tests
set -euo pipefail
here=$(cd "$1" && pwd)
packages="bounding-proxies bounding-proxies-doc libbp-dev libbp0 python3-bounding-proxies"
tools="bpcheck bpclose bpdeform bpinfo bplod bpmesh bpscale bpview bpvox"
doc=/usr/share/doc/bounding-proxies
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
export HOME=$work  # what shells note for themselves

step() { echo && echo "== $* ($SECONDS s)"; }
fail() { echo "FAILED: $*" >&2 && exit 1; }
apt() { apt-get -o Dpkg::Use-Pty=0 "$@" > "$work/apt.log" 2>&1 || { cat "$work/apt.log"; fail "apt-get $*"; }; }
# What is installed, less what package managers and caches note for themselves.
files() {
  find / -xdev \( -path /proc -o -path /sys -o -path /dev -o -path /tmp -o -path /run -o -path "$here" -o -path "$work" -o -path /var/cache \
    -o -path /var/lib/apt -o -path /var/lib/dpkg -o -path /var/log \) -prune -o -print | LC_ALL=C sort
}
# The code block of README below a line that begins with a text.
block() { awk -v head="$1" 'index($0, head) == 1 { found = 1 } found && /^```/ { if (inside) exit; inside = 1; next } inside' $doc/README.md; }

before=$(files)
step "an older version"
apt update
apt install -y "$here"/older/*.deb
[ "$(dpkg-query -W -f='${Version}\n' $packages | sort -u)" = 0.1.9-1 ] || fail "these are not the packages of 0.1.9"
step "upgrade"
apt install -y "$here"/*.deb
dpkg-query -W -f='${Package} ${Version} ${Architecture} ${Installed-Size} KiB\n' $packages
version=$(dpkg-query -W -f='${source:Upstream-Version}' libbp0)
dpkg --compare-versions "$version" gt 0.1.9 || fail "libbp0 is still of version $version"
for tool in $tools; do $tool --version | grep -q "^$tool $version+" || fail "$tool --version does not say $version"; done

step "the first jobs of README"
python3 $doc/samples/scenes.py scenes > /dev/null
cd scenes
for job in "**A collision body**" "**An occluder**"; do
  block "$job" > job.sh
  [ -s job.sh ] || fail "README has no commands below $job"
  bash -euxo pipefail job.sh > said 2>&1 || { cat said; fail "$job"; }
  grep -E '^\+|^holds' said
done
cd ..

step "the examples of the guide: Python, C and C++ with pkg-config"
python3 "$here/run_guide.py" $doc/docs/guides/library.md cc c++
python3 -c "from importlib.metadata import version; print('Python package', version('bounding-proxies'))"

step "a project with CMake"
cmake -S "$here/consumer" -B consumer -DWANTED="$version" > cmake.log || { cat cmake.log; fail "find_package(bp $version)"; }
cmake --build consumer > cmake.log || { cat cmake.log; fail "the consumer cannot be built"; }
consumer/consumer | tail -1

step "man pages and completion"
for tool in $tools; do
  MANWIDTH=80 man "$tool" 2>&1 | col -bx > page
  grep -q '^NAME' page && grep -q '^OPTIONS' page || fail "man $tool: $(head -3 page)"
  { grep -oE '/usr/share/doc/[a-z0-9/.-]+\.md' page || true; } | sort -u | while read -r named; do [ -e "$named" ] || fail "man $tool: $named is not there"; done
done
said=$(bash -c 'source /usr/share/bash-completion/bash_completion; _completion_loader bpmesh; COMP_WORDS=(bpmesh --mo) COMP_CWORD=1; _bpmesh; echo "$COMPREPLY"')
[ "$said" = --mode ] || fail "bash completes bpmesh --mo to: $said"
said=$(fish -c "complete -C'bpmesh --mo'" | cut -f 1)
[ "$said" = --mode ] || fail "fish completes bpmesh --mo to: $said"
said=$(zsh -fc 'autoload -Uz compinit; compinit -D; echo $_comps[bpmesh]')
[ "$said" = _bpmesh ] || fail "zsh completes bpmesh by: $said"
echo "9 pages; bash, fish and zsh complete"

step "the page of bpview"
bpview --no-open scenes/figure.obj > link &
for ((i = 0; i < 100; ++i)); do [ -s link ] && break || sleep 0.2; done
python3 -c "import gzip, sys, urllib.request as u
for name in '', 'page.js':
    page = gzip.decompress(u.urlopen(sys.argv[1] + name).read())
    assert (b'three.js' if name else b'page.js') in page, page[:200]
    print(name or '/', len(page), 'bytes')" "$(sed 's/#.*//' link)"
kill %1 && wait %1 || true

step "over themselves"
cp -r scenes again
apt install -y --reinstall "$here"/*.deb
dpkg --verify $packages
(cd again && bpcheck truck.obj truck-collision/truck_godot.glb | tail -1)
python3 -c "import bounding_proxies"

step "remove"
cd /
# Also what only a recommendation keeps: libproj25 brings ca-certificates by one, and the cmake of this root has a library that recommends it, too.
apt -o APT::AutoRemove::RecommendsImportant=false purge -y --autoremove $packages
after=$(files)
diff <(echo "$before") <(echo "$after") || fail "the packages leave files"
! dpkg-query -W $packages 2> /dev/null | grep . || fail "dpkg remembers packages"
echo "nothing is left ($SECONDS s)"
