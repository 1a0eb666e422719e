# Parts of a check find what one check finds, for any way to break a tileset; they hold if it holds.
write_painted_cubes
bplod part*.obj --name cubes --voxel 0.1 --tile 128 --profile 3dtiles --levels 3 --leaves scene -o good -q > list
bpcheck part*.obj good
for k in 1 2 3; do bpcheck part*.obj good --part $k/3; done
bpcheck good --part 2/2 --json | grep -A 3 '"part"'

# broken NAME COMMAND...: in a copy. What each part says of the tileset itself is there once for each.
broken() {
  local status=0 part one=0 k
  rm -rf bad && cp -r good bad
  (cd bad && "${@:2}")
  bpcheck -q "${scene[@]}" bad | grep -v '^tileset.json: ' | sort -u > whole; status=${PIPESTATUS[0]}
  : > parts
  for k in {1..5}; do
    bpcheck -q "${scene[@]}" bad --part $k/5 > part || { part=$?; [ $one = 1 ] || one=$part; }
    grep -v '^tileset.json: ' part >> parts
  done
  diff whole <(sort -u parts) && echo "$1: $(wc -l < whole) findings, $status and $one"
}
content() { ls cubes_LOD0/*.glb | sed -n "$1p"; }
json() { python3 -c 'import json, sys
t = json.load(open("tileset.json"))
def tiles(t):
    yield t
    for c in t.get("children", []):
        yield from tiles(c)
all = list(tiles(t["root"]))
exec(sys.argv[1])
json.dump(t, open("tileset.json", "w"))' "$1"; }
scene=(part*.obj)
for i in 1 2 3; do broken "content $i is missing" eval 'rm "$(content $i)"'; done
broken "no file but the tileset" rm -r cubes_LOD0 cubes_leaves
broken "half a content" eval 'truncate -s 300 "$(content 2)"'
broken "another tile's content" eval 'cp "$(content 1)" "$(content 2)"'
broken "contents that change places" eval 'mv "$(content 1)" x; mv "$(content 3)" "$(content 1)"; mv x "$(content 3)"'
broken "a leaf of another tile" eval 'cp "$(ls cubes_leaves/*.glb | head -1)" "$(ls cubes_leaves/*.glb | tail -1)"'
broken "an error above the parent's" json 'all[-1]["geometricError"] = 1e6'
broken "a child with a child's cell" json 'all[0]["children"].append(all[0]["children"][0])'
broken "a child less" json 'all[0]["children"].pop()'
broken "a child less of a tile with many" json 'max(all, key=lambda a: len(a.get("children", [])))["children"].pop(0)'
broken "a tile that draws nothing" json 'del [a for a in all if "content" in a and not a.get("children")][0]["content"]'
broken "a smaller box" json 'b = all[0]["boundingVolume"]["box"]; b[3:] = [x / 2 for x in b[3:]]'
sed '/^v /s/^v \([^ ]*\)/v 9\1/' part0.obj > far.obj
scene=(part*.obj far.obj)
broken "a scene that leaves the root" true
scene=(part0.obj part0.obj)
broken "a scene that has less" true
scene=()
broken "without a scene" eval 'rm "$(content 2)"'

try bpcheck good --part 3/2
try bpcheck good --part 1
try bpcheck part0.obj part0.obj --part 1/2
