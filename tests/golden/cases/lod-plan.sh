# What --explain says is what a run does; --tiles fills a cache in parts, and the run that puts them together gives the bytes of one run.
for i in 0 1 2; do
  write_cube cube.obj 3
  sed "s/^v \(.*\) \(.*\) \(.*\)$/echo v \$((\1 + 7 * $i)) \2 \$((\3 + $i))/e" cube.obj > part$i.obj
done
options=(part*.obj --name cubes --voxel 0.025 --tile 256 --profile 3dtiles -q)
numbers() { sed "/\"options\"/,/^  }/d" "$2" | grep -oE "\"($1)\": [0-9.]*" | tr '\n' ' '; echo; }
# The plan needs no voxel: these figures are exact, but for "at most" and "about". Nothing is written.
bplod "${options[@]}" --explain -j 1 --memory 1G
bplod "${options[@]}" --explain --cache none --report plan.json > list
tail -2 list
ls none 2> /dev/null
bplod "${options[@]}" -o whole --report whole.json > list
numbers 'voxel|tiles_at_most|tiles|scale' plan.json
numbers 'voxel|tiles|scale' whole.json

# Three parts, two at a time, then all: nothing is left to do but to write.
bplod "${options[@]}" --cache cache --tiles 0..4 > list & bplod "${options[@]}" --cache cache --tiles 4..7 > list2 & wait
cat list list2
bplod "${options[@]}" --cache cache --explain | grep kept
bplod "${options[@]}" --cache cache --tiles 7..11 --report part.json
bplod "${options[@]}" --cache cache --explain | grep kept
numbers 'begin|end|of' part.json
ls
bplod "${options[@]}" --cache cache -o together --report together.json > list
numbers kept together.json
diff -r whole together && echo "the same bytes"
bpcheck part*.obj together/tileset.json | sed 's/[0-9]* triangles/some triangles/'
# A part that was done, or that has no number, costs nothing; the latter is said.
bplod "${options[@]}" --cache cache --tiles 0..4
bplod "${options[@]}" --cache cache --tiles 30..40
try bplod part*.obj --name cubes --voxel 0.025 --tile 256 --profile 3dtiles --cache cache --tiles 30..40
try bplod "${options[@]}" --tiles 0..2 --cache cache -o nowhere

# Without any voxels, the scene decides: its bounds, and how many triangles it has; a run does what the plan says.
many=(); for i in {1..150}; do many+=(part0.obj part1.obj part2.obj); done
for scene in "part0.obj part1.obj part2.obj" "${many[*]}"; do
  read -ra scene <<< "$scene"
  bplod "${scene[@]}" --name cubes --profile 3dtiles --explain --report plan.json --overwrite -q | sed -n 2p
  bplod "${scene[@]}" --name cubes --profile 3dtiles -o by-scene --report whole.json --overwrite -q > list
  diff <(numbers voxel plan.json | cut -d ' ' -f 1-4) <(numbers voxel whole.json | cut -d ' ' -f 1-4) && echo "as planned"
done
bplod "${many[@]}" --name cubes --profile 3dtiles --faces 100 --explain -q | sed -n 2p
# More triangles than the voxels are for are said, unless somebody named voxels.
bp-plant --triangles 200000 -o plant.ply > list
said 'bplod plant.ply --profile 3dtiles --explain | sed -n 2p'
said 'bplod plant.ply --profile 3dtiles --explain --resolution 300 | sed -n 2p'
rm plant.ply

# What a change costs is known before it is paid.
sed -i 's/^v \(.*\) 3 \(.*\)$/v \1 2 \2/' part2.obj
bplod "${options[@]}" --cache cache --explain | grep kept
bplod "${options[@]}" --cache cache -o changed --report changed.json > list
numbers kept changed.json
bplod "${options[@]}" --cache cache --explain | grep kept

# The same of a cache that has half of it; levels in one mesh are estimated.
cp -r cache half
rm -r half/[0-7]*
bplod "${options[@]}" --cache half --explain | grep kept > planned
bplod "${options[@]}" --cache half -o resumed --report resumed.json > list
diff <(sed -n 's/.*level .: \(.*\) of.*/\1/p' planned) <(grep -oE '"kept": .*' resumed.json | grep -o '[0-9]*') && echo "as planned"
diff -r changed resumed && echo "the same bytes"
bplod part0.obj --name cube --resolution 40 --faces 200,50 --explain --memory 1G -j 1
bplod part0.obj --name cube --resolution 40 --error 0.5 --profile collision --explain --memory 1G -j 1 | tail -1
try bplod "${options[@]}" --tiles 0..2
try bplod "${options[@]}" --tiles 0..2 --cache cache --explain
try bplod "${options[@]}" --tiles 2..0 --cache cache
try bplod "${options[@]}" --tiles 2 --cache cache
try bplod part0.obj --tiles 0..1 --cache cache
try bplod part9.obj --explain
try bplod - --format obj --explain --profile 3dtiles --cache cache
files

# The memory of a plan is that of the note of a run: triangles that levels enclose or follow count.
bp-plant --triangles 50000 -o plant.ply > /dev/null
for kind in "--enclose input" "--enclose scene" "--mode fit"; do
  echo "$kind: $(bplod plant.ply --resolution 200 $kind --explain -j 1 --memory 1G | grep ^time)"
done
