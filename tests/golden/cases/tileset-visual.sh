# Tilesets that show the scene: its own triangles in every tile, or fewer. Two cubes, one with an image, and a ball.
write_painted_cubes
write_ball ball.obj 30
visual=(part*.obj ball.obj --name cubes --profile 3dtiles --mode visual --faces 100 -q)

bplod "${visual[@]}" --explain
bplod "${visual[@]}" -o first --cache cache --report first.json | cut -f 1,2,3
kept first.json
ls first first/cubes_tiles
bplod "${visual[@]}" -o again -j 1 --cache cache --report again.json > list
kept again.json
bplod "${visual[@]}" -o from-nothing -j 1 --memory 300M > list
same first again
same first from-nothing
# The tiles at the ends are the scene; those above have smaller images.
bpinfo first | grep -e level -e bounds
grep -aoh '"uri":"[^"]*"' first/cubes_tiles/*.glb | sort | uniq -c
grep -o '"geometricError": [^,]*' first/tileset.json | sort | uniq -c
bpvox first --resolution 64 -o first.bpv && bpinfo first.bpv | grep -e triangles -e bounds
bpcheck part0.obj part1.obj ball.obj first > list || echo "= $?"
try bpcheck --claimed part0.obj part1.obj ball.obj first
bpcheck --claimed --json first || echo "= $?"
# A changed image is another file, and only tiles that show it are made again.
chequer blue
bplod "${visual[@]}" -o first --overwrite --cache cache --report painted.json > list
kept painted.json
bplod "${visual[@]}" -o painted > list
same first painted
for option in '--voxel 1' '--scale 1' '--levels 2' '--leaves scene' '--tile 64' '--faces 100,10' '--error 1' '--field x'; do
  try bplod part0.obj --profile 3dtiles --mode visual -o x $option
done
try bplod - --format obj --profile 3dtiles --mode visual -o x
try bplod part0.obj ball.obj --profile 3dtiles --mode visual -o x --memory 20M
printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n' > line.obj
try bplod line.obj --profile 3dtiles --mode visual -o x
# A broken image is left out, and a part far away coarsens the lattice.
head -c 60 chequered.png > broken.png && mv broken.png chequered.png
{ cat part0.obj; echo 'v 1e6 0 0'; echo 'v 1e6 1 0'; echo 'v 1e6 0 1'; echo 'f -1 -2 -3'; } > far.obj
said 'bplod far.obj --profile 3dtiles --mode visual -o far | cut -f 1,2'
ls far/far_tiles
