# Rules of a scale field: by bpscale, bpclose --field and bplod --field; what a point gets, and where a point is.
write_cube cube.obj 2
bpvox cube.obj --resolution 100 -o cube.bpv
echo '{"base": "8vx", "rules": [{"at": [0, 0, 0], "radius": 0.5, "scale": "2vx", "name": "corner"},
 {"box": [[1.5, 1.5, 1.5], [2, 2, 2]], "scale": "1%", "mode": "decrease"},
 {"view": [[-3, 1, 1], [-3, 1, 9]], "per_distance": 0.05, "scale": 0.3}]}' > rules.json
said 'bpscale rules.json cube.bpv -o scaled.bpv'
said 'bpinfo scaled.bpv --json | grep -A 12 "\"scale\""'
said 'bpinfo scaled.bpv | grep -E "^(scale|element|made)" | sed "s/+[0-9a-f]*//"'
# Both ways to the same closing, whatever the threads and the memory.
said 'bpclose scaled.bpv -j 1 | bpinfo | checksum'
said 'bpscale rules.json cube.bpv | bpclose -j 3 --memory 100M | bpinfo | checksum'
said 'bpclose --field rules.json cube.bpv | bpinfo | checksum'
said 'bpclose --field rules.json cube.bpv | bpinfo | grep -E "^(scale|element)"'
try bpscale rules.json cube.bpv --explain 0.1,0.1,0.1
try bpscale rules.json cube.bpv --explain 1,1,1
try bpscale rules.json cube.bpv --explain 1e30,1,1
try bpscale rules.json cube.bpv --explain 1,1,1 -o x.bpv
# Files of earlier versions.
echo '{"base": 0.1, "boxes": [{"min": [0, 0, 0], "max": [1, 1, 1], "scale": 0.05}],
 "strokes": [{"mode": "increase", "position": [2, 2, 2], "support": 0.5, "target": 0.2}]}' > old.json
try bpscale old.json cube.bpv --explain 1.9,1.9,1.9
# Parts of a scene, by name and by material.
{ cat cube.obj | sed '/^f/d'; echo 'o lid_top'; sed -n 's/^f 5/f 5/p' cube.obj
  echo 'o body'; echo 'usemtl steel'; sed -n '/^f/p' cube.obj | grep -v 'f 5'; } > parts.obj
bpvox parts.obj --resolution 100 -o parts.bpv
for name in 'lid_*' steel nothing; do
  echo "{\"base\": 0.1, \"rules\": [{\"node\": \"$name\", \"radius\": 0.1, \"scale\": 0.03}]}" > names.json
  try bpscale names.json parts.bpv --explain 1,1,1.95
done
said 'bpvox - --format obj --resolution 20 < parts.obj | bpscale names.json | bpinfo'
echo 'o more' >> parts.obj
try bpscale names.json parts.bpv --explain 1,1,1
# Where parts are.
try bpinfo parts.obj --boxes 'lid_*'
try bpinfo parts.obj --boxes nothing
try bpinfo parts.obj --boxes lid_tap
said 'bpinfo parts.obj | grep names'
said 'bpinfo parts.obj --json | grep -A 9 \"names\"'
try bpinfo parts.bpv --boxes steel
try bpinfo parts.obj --boxes steel --json
# By the shape: two boxes with a gap of 0.3, and a pole of 0.1 at 0.2 beside one of them.
boxes() {
  local n=0 b
  for b in "$@"; do
    set -- $b
    for z in $3 $6; do printf 'v %s %s %s\n' $1 $2 $z $4 $2 $z $4 $5 $z $1 $5 $z; done
    for f in '1 4 3 2' '5 6 7 8' '1 2 6 5' '2 3 7 6' '3 4 8 7' '4 1 5 8'; do
      set -- $f
      echo "f $((n + $1)) $((n + $2)) $((n + $3)) $((n + $4))"
    done
    n=$((n + 8))
  done
}
boxes '0 0 0 1 1 1' '1.3 0 0 2.3 1 1' '2.5 0 0.4 2.6 1.6 0.5' > shapes.obj
bpvox shapes.obj --resolution 128 -o shapes.bpv
for rule in '"thickness": 0.1' '"gap": 0.25' '"gap": 0.4' '"gap": 0.4, "mode": "decrease"'; do
  echo "{\"base\": 0.3, \"rules\": [{$rule}]}" > shape.json
  said 'cat shape.json; bpscale shape.json shapes.bpv -j 1 | bpinfo | grep -E "^scale"'
  said 'bpscale shape.json shapes.bpv -o - | bpclose | bpinfo | checksum'
  said 'bpscale shape.json shapes.bpv -j 3 --memory 100M | bpclose | bpinfo | checksum'
  said 'bpclose --field shape.json shapes.bpv --memory 100M | bpinfo | checksum'
  try bpscale shape.json shapes.bpv --explain 1.15,0.5,0.5
  try bpscale shape.json shapes.bpv --explain 2.4,0.5,0.45
done
said 'bplod shapes.obj --field shape.json --levels 1 --faces 300 --resolution 64 -q -o shapes > list && bpcheck shapes.obj shapes/shapes.glb | tail -1'
for rule in '"gap": 4' '"thickness": "101%"' '"gap": 0.01, "mode": "decrease"' '"gap": 0.3, "radius": 1'; do
  echo "{\"base\": 0.3, \"rules\": [{$rule}]}" > odd.json
  said 'cat odd.json; bpscale odd.json shapes.bpv | bpinfo | grep -E "^scale"'
done
said 'bpvox shapes.obj --resolution 64 --fill inside | bpscale shape.json -o x.bpv'
# Edges: by default a flat side in a fine place takes few faces; --edge-factor is a promise for each edge.
echo '{"base": 0.4, "rules": [{"box": [[-1, -1, -1], [3, 3, 3]], "scale": 0.05}]}' > everywhere.json
bpvox cube.obj --resolution 64 -q | bpclose --field everywhere.json -q -o fine.bpv
for option in "" "--edge-factor 4"; do
  bpmesh fine.bpv --faces 40 $option -q --report edges.json -o edges.ply --overwrite
  python3 - << 'P'
import json
level = json.load(open("edges.json"))["counts"]["levels"][0]
print("faces", "few," if level["faces"] <= 40 else "many,", "edges", "short," if level["edge_length"]["max"] <= 4 * 0.05 + 1e-9 else "long,",
      level["stopped_by"], level.get("edges_longer_near_closing"))
P
  said 'bpcheck cube.obj edges.ply | tail -1'
done
try bpmesh fine.bpv --faces 40 --edge-factor 0 -o x.ply
try bpmesh cube.bpv --faces 40 --edge-factor 4 -o x.ply
rm edges.* everywhere.json fine.bpv
# What is refused.
try bpscale
try bpscale cube.bpv rules.json -o x.bpv
try bpscale missing.json cube.bpv -o x.bpv
try bpscale rules.json missing.bpv -o x.bpv
try bpscale rules.json cube.bpv -o x.obj
try bpscale rules.json cube.bpv -o scaled.bpv
try bpclose scaled.bpv --scale 2% -o x.bpv
try bpclose scaled.bpv --field rules.json -o x.bpv
bpclose scaled.bpv -q -o closed.bpv
try bpscale rules.json closed.bpv -o x.bpv
refused() { echo "$1" > bad.json; try bpscale bad.json cube.bpv -o x.bpv; }
refused '{"rules": []}'
refused '{"base": "2px"}'
refused '{"base": 1, "rules": [{"scale": 1}]}'
refused '{"base": 1, "rules": [{"at": [0, 0, 0], "box": [[0, 0, 0], [1, 1, 1]], "scale": 1}]}'
refused '{"base": 1, "rules": [{"at": [0, 0], "scale": 1}]}'
refused '{"base": 1, "rules": [{"at": [0, 0, 0], "scales": 1}]}'
refused '{"base": 1, "slope": 0.1, "rules": [{"view": [0, 0, 0], "per_distance": 0.2, "scale": 1}]}'
refused '{"base": 1, "boxes": [], "rules": []}'
refused '{"base": 1, "rules": [{"thickness": 0}]}'
refused '{"base": 1, "rules": [{"thickness": 1, "mode": "set"}]}'
refused '{"base": 1, "rules": [{"gap": 1, "mode": "erase"}]}'
refused '{"base": "5000vx"}'
refused '{"base": 0.1, "rules": [{"at": [90, 90, 90], "scale": 0.05}]}'
rm -f x.bpv
# Levels: a rule is to the base as the scale there is to the level's.
echo '{"base": 1, "rules": [{"at": [0, 0, 0], "radius": 0.5, "scale": 0.25}]}' > finer.json
said 'bplod cube.obj --field finer.json --faces 60 --levels 1 --resolution 64 -q -o lod > list && bpcheck cube.obj lod/cube.glb | tail -1'
try bplod cube.obj --profile 3dtiles --field finer.json -o tiles
try bplod cube.obj --profile occluder --field finer.json -o occluder
refused_base() { echo '{"base": 0}' > zero.json; try bplod cube.obj --field zero.json --resolution 16 -o zero; }
refused_base
# The point at a pixel.
try bpinfo cube.obj --pick 360,360
try bpinfo cube.obj --view 0,0 --pick 360,300
try bpinfo cube.bpv --view 0,0 --pick 360,300
try bpinfo cube.obj --pick 0,0
try bpinfo cube.obj --pick 720,0
try bpinfo cube.obj --pick 7
try bpinfo cube.obj --pick 1,2 --json
files

# Slips: a number in quotes, and a field that nobody closes by.
echo '{"base": "3%", "rules": [{"at": [1, 1, 1], "scale": "0.5"}]}' > bad.json
try bpscale bad.json cube.bpv -o x.bpv
echo '{"base": "3%"}' > base.json
bpscale base.json cube.bpv -q | bpmesh --faces 60 -o unclosed.ply 2>&1 | grep field
