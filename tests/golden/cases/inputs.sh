# --inputs names what was read and what was looked for; names of files in a folder of outputs are replaced, not written through.
write_painted_cubes
mkdir "images #1" && mv chequered.png "images #1/a \$b.png"
sed -i 's|map_Kd .*|map_Kd images #1/a $b.png|' cubes.mtl
printf 'newmtl other\nmap_Kd lost.png\n' >> cubes.mtl
options=(part0.obj --faces 12 --levels 1 --resolution 16 -q)
bplod "${options[@]}" -o out --inputs read > list
cat read
try bplod "${options[@]}" -o new --inputs read
try bplod "${options[@]}" --explain --inputs new
cp part0.obj $'line\nbreak.obj'
try bplod $'line\nbreak.obj' --name line "${options[@]:1}" -o new --inputs new-read 2>&1 | tail -2
ls new-read 2> /dev/null

# What has the name of a level is replaced, and neither waited for nor written through.
mkdir pipes && mkfifo pipes/part0_LOD0.glb pipes/part0.glb
try bplod "${options[@]}" -o pipes
bplod "${options[@]}" -o pipes --overwrite > list && diff -r out pipes && echo "the same bytes"
mkdir links && ln -s /dev/null links/part0_LOD0.glb
try bplod "${options[@]}" -o links
bplod "${options[@]}" -o links --overwrite > list && diff -r out links && echo "the same bytes"
# So is what has the name of a kept result, and of a file of a tileset.
options=(part0.obj --faces 12 --resolution 16 -q --profile 3dtiles)
bplod "${options[@]}" -o tiles --cache cache > list
find cache -mindepth 2 -type f | while read -r f; do rm "$f" && mkfifo "$f"; done
bplod "${options[@]}" -o tiles2 --cache cache > list && diff -r tiles tiles2 && echo "the same bytes"
find cache -mindepth 2 -type p | wc -l
rm tiles/tileset.json && mkfifo tiles/tileset.json
bplod "${options[@]}" -o tiles --overwrite > list && diff -r tiles tiles2 && echo "the same bytes"

# A pipe that can be no scene is refused by its first bytes, and not when it ends, which it may never do.
try bpvox /dev/zero -o zero.bpv
said 'bpvox part0.obj --resolution 8 -q | bpcheck -'
