# Occluders of scenes with doors, windows and inner walls: what bplod makes, bpcheck proves, and refutes where it is not so.
# write_house FILE [PART...]: a house of 8 x 6 x 3 with a door; parts: front, inner, glass, floor.
write_house() {
  local file=$1 boxes="-0.3 -0.3 3 8.3 6.3 3.3 -0.3 -0.3 0 0 6.3 3 8 -0.3 0 8.3 6.3 3 0 6 0 8 6.3 3"  # roof, three walls
  shift
  for part in "$@"; do
    case $part in
      front) boxes+=" 0 -0.3 0 3 0 3 4 -0.3 0 8 0 3 3 -0.3 2 4 0 3" ;;  # a door from x 3 to 4, 2 high
      inner) boxes+=" 5 0 0 5.1 6 2.5" ;;
      floor) boxes+=" -0.3 -0.3 -0.3 8.3 6.3 0" ;;
    esac
  done
  awk -v list="$boxes" -v glass="${*: -1}" 'BEGIN {
    if (glass == "glass") print "mtllib house.mtl\nusemtl wall"
    n = split(list, x, " ")
    for (i = 1; i <= n; i += 6) {
      for (k = 0; k < 8; ++k) print "v", x[i + (k % 2) * 3], x[i + 1 + (int(k / 2) % 2) * 3], x[i + 2 + int(k / 4) * 3]
      split("1 3 4 2 5 6 8 7 1 2 6 5 3 7 8 4 1 5 7 3 2 4 8 6", f, " ")
      for (k = 1; k <= 24; k += 4) print "f", f[k] + c, f[k + 1] + c, f[k + 2] + c, f[k + 3] + c
      c += 8
    }
    if (glass == "glass") print "usemtl pane\nv 3 -0.2 0\nv 4 -0.2 0\nv 4 -0.2 2\nv 3 -0.2 2\nf -4 -3 -2 -1"
  }' > "$file"
}
facts() { grep -E '"(ground|opening|parts)"' "$1" | sed 's/^ *//' | tr -d '\n'; echo; }
write_house house.obj front inner floor
try bplod house.obj --profile occluder --resolution 128 --up z -o out --report house.json
facts house.json
said 'bpcheck --inside house.obj out/house_occluder.glb'
said 'bpcheck --inside house.obj out/house_occluder.glb --json | grep -E "\"(holds|answer|why|mesh|outward|inside|free_of_scene|hidden)\""'
# What the voxels need is named, and will do.
bplod house.obj --profile occluder --resolution 512 --up z -o fine -q > /dev/null
bpcheck --inside house.obj fine/house_occluder.glb -j 1 --memory 64M 2>&1 | sed -n 's/[0-9]* MiB/N MiB/g; /hidden/p'
bpcheck --inside house.obj fine/house_occluder.glb -j 1 --memory 64M 2> said > /dev/null
least=$(grep -o 'at least [0-9]*' said | grep -o '[0-9]*')
bpcheck --inside house.obj fine/house_occluder.glb -j 1 --memory "${least}M" -q | tail -1
rm -r fine said
# A wall of the scene is gone: the same file is refuted, with places.
write_house ruin.obj inner floor
said 'bpcheck --inside ruin.obj out/house_occluder.glb | sed -n "/free of the/,/volume/p"'
# Nothing closed: nothing but what the walls hold. A pane that can be seen through closes nothing either, one that cannot does.
try bplod house.obj --profile occluder --resolution 128 --up z --scale 0 -o zero --report zero.json -q
facts zero.json
write_house glass.obj front floor glass
printf 'newmtl wall\nnewmtl pane\nd 0.3\n' > house.mtl
try bplod glass.obj --profile occluder --resolution 128 --up z -o glass
said 'bpcheck --inside glass.obj glass/glass_occluder.glb | tail -1'
printf 'newmtl wall\nnewmtl pane\nd 1\n' > house.mtl
try bplod glass.obj --profile occluder --resolution 128 --up z -o pane
said 'bpcheck --inside glass.obj pane/glass_occluder.glb | grep -E "free|inside|hidden|hold"'
# Without a floor it stands on the ground.
write_house barn.obj front
try bplod barn.obj --profile occluder --resolution 128 --up z -o barn
said 'bpcheck --inside barn.obj barn/barn_occluder.glb | grep -E "free|inside|hidden|hold"'
# Same bytes, whatever the threads and the memory.
said 'bplod house.obj --profile occluder --resolution 128 --up z -o again -j 1 --memory 512M -q > /dev/null && cmp out/house_occluder.glb again/house_occluder.glb'
# An open sheet hides nothing, and what has no meaning is refused.
printf 'v 0 0 0\nv 9 0 1\nv 0 9 2\nf 1 2 3\n' > sheet.obj
try bplod sheet.obj --profile occluder -o sheet
try bplod house.obj --profile occluder --mode fit -o wrong
try bplod house.obj --profile occluder --faces 200,100 -o wrong
try bplod house.obj --profile occluder --error 1 -o wrong

# A hollow's cavity lies behind walls; it was made, and refused by bpcheck.
said 'bpvox "$BP_ROOT/tests/data/bugs/hollow.obj" --resolution 48 --fill inside | bpclose --scale 1vx | bpmesh --mode inside --faces 12 -o cavity.ply'
said 'bpcheck --inside "$BP_ROOT/tests/data/bugs/hollow.obj" cavity.ply | grep -E "free|inside|hold"'
# Nothing is refuted of an open scene that hides the proxy along all axes, and nothing proven: 5.
write_cube small.obj 1
awk '$1 == "v" { print $1, 3 * $2 - 1, 3 * $3 - 1, 3 * $4 - 1; next } { print }' small.obj > open.obj
echo 'f 1 2 3' >> open.obj  # one edge of it is used once
try bpcheck --inside open.obj small.obj
said 'bpcheck --inside open.obj small.obj --json | grep -E "\"(holds|answer|why|inside)\""'
# Seen along an axis: refuted.
grep -v 'f 5 6 7 8' open.obj > lid.obj
said 'bpcheck --inside lid.obj small.obj | tail -1'

# A sound tileset far from the origin, where a cell is small beside what its coordinates are rounded to, was left undecided.
write_octahedron near.obj 3
awk '$1 == "v" { printf "v %.7f %.7f %.7f\n", $2 + 4099998.8939953, $3 - 629999.1995152, $4 + 4800000.7473774; next } { print }' near.obj > far.obj
said 'bplod far.obj --profile 3dtiles --tile 64 --resolution 150 --up z -o far -q > /dev/null && bpcheck far.obj far/tileset.json'

# What would be tried, without a run, and what is shown while it is.
try bplod house.obj --profile occluder --resolution 128 --up z --explain -j 1 --memory 1G
try bplod house.obj --profile occluder --scale 0.5 --faces 60 --explain -q -j 1 --memory 1G --report explained.json
said 'sed -n "/\"counts\"/,\$p" explained.json | grep -oE "\"(levels|jobs|scales|openings)\""'
said 'bplod house.obj --profile occluder --resolution 64 --up z -o shown --progress json 2>&1 > /dev/null | grep -o "\"pass\":\"closing.*\"done\":.*,\"unit\":\"[a-z]*\"" | sort -t : -k 3n | tail -1'

# Openings that none of the scales close which are a factor apart, but the largest scale that may be tried.
said 'bplod "$BP_ROOT/tests/data/bugs/open_walls.obj" --profile occluder --up y --resolution 128 -q -o walls | cut -f 2,4'
