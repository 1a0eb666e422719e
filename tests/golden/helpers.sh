# Helpers of the golden cases. A case prints a transcript: each command, what it said, how it ended.

# try COMMAND...: runs it without input; shows stderr with a bar before each line, and the exit status unless it is 0.
try() {
  echo "\$ $*"
  local status=0
  "$@" 2> .stderr < "${stdin:-/dev/null}" || status=$?
  outcome $status
}

# outcome STATUS: what try and said print of a command; without what is told of slow machines alone.
outcome() {
  sed '/ are \(tried\|taken\).*: about /d; s/^/| /' .stderr
  rm -f .stderr
  [ "$1" = 0 ] || echo "= $1"
}

# said COMMAND...: as try, for a whole pipe in a string.
said() {
  echo "\$ $1"
  local status=0
  (set -o pipefail; eval "$1") 2> .stderr < /dev/null || status=$?
  outcome $status
}

# files: what lies in the folder now, hidden and partial files too.
files() { echo "files: $(LC_ALL=C ls -A | tr '\n' ' ')"; }

# bpinfo FILE | checksum: of its voxels or triangles.
checksum() { sed -n 's/^checksum *//p'; }

# write_ball FILE.obj [SIZE]: 224 triangles; each level of it has fewer faces than the one before.
write_ball() {
  awk -v s="${2:-1}" 'BEGIN {
    pi = atan2(0, -1); n = 16; rings = 7; h = s / 2
    print "v " h, h, 0
    for (r = 1; r <= rings; ++r) for (i = 0; i < n; ++i) {
      a = pi * r / (rings + 1); b = 2 * pi * i / n
      printf "v %.4f %.4f %.4f\n", h + h * sin(a) * cos(b), h + h * sin(a) * sin(b), h - h * cos(a)
    }
    print "v " h, h, s
    for (i = 0; i < n; ++i) {
      j = (i + 1) % n; top = 2 + (rings - 1) * n
      print "f 1", 2 + j, 2 + i
      for (r = 0; r < rings - 1; ++r) print "f", 2 + r * n + i, 2 + r * n + j, 2 + (r + 1) * n + j, 2 + (r + 1) * n + i
      print "f", top + i, top + j, top + n
    }
  }' > "$1"
}

# write_octahedron FILE.obj [SIZE]
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

# same A B: whether two folders hold the same bytes.
same() { diff -r "$1" "$2" > differences && echo "$1 and $2: the same bytes" || echo "$1 and $2 differ: $(wc -l < differences)"; }

# kept REPORT: what of the results was in the cache.
kept() { grep -o '"kept": [0-9]*' "$1" | tr '\n' ' '; echo; }

# chequer red|blue: writes chequered.png.
chequer() {
  local middle=hQROyMnBEQMVJZA5yIqoKAEAaed+QclKqjgAAAAA
  [ "$1" = red ] || middle=hQTk5E7AEQMVJZA5yIqoKAEAP2d+Qe6vEAoAAAAA
  base64 -d <<< "iVBORw0KGgoAAAANSUhEUgAAAAgAAAAICAIAAABLbSncAAAAGklEQVR42mP4${middle}SUVORK5CYII=" > chequered.png
}

# write_painted_cubes: part0.obj, whose image is chequered.png, and part1.obj in a row with it.
write_painted_cubes() {
  local i
  printf 'newmtl chequered\nKd 0 1 0\nmap_Kd chequered.png\nnewmtl plain\nKd 0 0 1\n' > cubes.mtl
  chequer red
  write_cube cube.obj 3
  for i in 0 1; do
    { echo "mtllib cubes.mtl"; echo "vt 0 0"; echo "vt 1 0"; echo "vt 1 1"; echo "vt 0 1"; echo "usemtl $([ $i = 0 ] && echo chequered || echo plain)"
      sed "s/^v \(.*\) \(.*\) \(.*\)$/echo v \$((\1 + 40 * $i)) \2 \3/e; s/^f \(.*\) \(.*\) \(.*\) \(.*\)$/f \1\/1 \2\/2 \3\/3 \4\/4/" cube.obj; } > part$i.obj
  done
}

# answer RIGHT NAME ARGUMENT...: what bpcheck answers to the arguments, and whether that is RIGHT: proven, refuted, undecided or refused.
answer() {
  local right=$1 name=$2 status=0 got
  bpcheck "${@:3}" > verdict 2> note || status=$?
  case $status in 0) got=proven;; 1) got=refuted;; 5) got=undecided;; 3) got=refused;; *) got="exit $status";; esac
  [ "$got" = "$right" ] || echo "WRONG, is to be $right:"
  echo "$name: $got; $(if [ $status = 3 ]; then cat note; else tail -1 verdict; fi)"
}

# answers SCENE FOLDER... < TABLE: an answer() for each line of a table: the right one, a file in one of these folders of tests/data/bugs, and
# whether it is the scene, in a large box around.obj, or the proxy, around SCENE. cube.obj must be there.
answers() {
  local inner=$1 right file role folder
  shift
  awk '/^v/ { print "v", $2 * 9 - 4, $3 * 9 - 4, $4 * 9 - 4; next } { print }' cube.obj > around.obj
  while read -r right file role; do
    for folder; do cp "$BP_ROOT/tests/data/bugs/$folder/$file" . 2> /dev/null && break; done
    if [ "$role" = proxy ]; then answer "$right" "$role $file" "$inner" "$file"; else answer "$right" "$role $file" "$file" around.obj; fi
  done
}
