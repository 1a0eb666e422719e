# Helpers of the golden cases. A case prints a transcript: each command, what it said, how it ended.

# try COMMAND...: runs it without input; shows stderr with a bar before each line, and the exit status unless it is 0.
try() {
  echo "\$ $*"
  local status=0
  "$@" 2> .stderr < "${stdin:-/dev/null}" || status=$?
  sed 's/^/| /' .stderr
  rm -f .stderr
  [ $status = 0 ] || echo "= $status"
}

# said COMMAND...: as try, for a whole pipe in a string.
said() {
  echo "\$ $1"
  local status=0
  (set -o pipefail; eval "$1") 2> .stderr < /dev/null || status=$?
  sed 's/^/| /' .stderr
  rm -f .stderr
  [ $status = 0 ] || echo "= $status"
}

# files: what lies in the folder now, hidden and partial files too.
files() { echo "files: $(LC_ALL=C ls -A | tr '\n' ' ')"; }

# bpinfo FILE | checksum: of its voxels or triangles.
checksum() { sed -n 's/^checksum *//p'; }

# write_octahedron FILE.obj [SIZE]: its slanted sides have as many faces as a level may want.
write_octahedron() {
  awk -v s="${2:-1}" 'BEGIN {
    h = s / 2
    print "v " s, h, h "\nv " 0, h, h "\nv " h, s, h "\nv " h, 0, h "\nv " h, h, s "\nv " h, h, 0
    print "f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6"
  }' > "$1"
}

# write_cube FILE.obj [SIZE]: a closed cube.
write_cube() {
  local s=${2:-1}
  cat > "$1" << OBJ
v 0 0 0
v $s 0 0
v $s $s 0
v 0 $s 0
v 0 0 $s
v $s 0 $s
v $s $s $s
v 0 $s $s
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
OBJ
}
