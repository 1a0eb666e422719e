# The folder of the levels: nothing in it is lost unasked.
write_ball cube.obj 3  # each level has fewer faces
options=(cube.obj --name m --resolution 24 --faces 200 --levels 3 -q)
tileset=("${options[@]}" --profile 3dtiles)

# A tileset does not replace levels that are there, neither all of them nor some.
bplod "${options[@]}" -o mixed > list
try bplod "${tileset[@]}" -o mixed
rm mixed/m_LOD[01].glb
try bplod "${tileset[@]}" -o mixed
mkdir -p mixed2/m_LOD0
bplod "${tileset[@]}" -o mixed2 | cut -f 1  # an empty folder is nothing
# Of a long pipe there are more levels than anybody asked for: found out before anything is moved.
sed 's/^v 3/v 550/' cube.obj > pipe.obj
mkdir mixed3
echo kept > mixed3/p_LOD4.glb
try bplod pipe.obj --name p --voxel 0.5 --tile 128 --profile 3dtiles -q -o mixed3
cat mixed3/p_LOD4.glb
LC_ALL=C ls -A mixed mixed3

# A scene in that folder is neither replaced nor taken away, by whatever name.
mkdir scenes
cp cube.obj scenes/cube.obj
bplod scenes/cube.obj "${tileset[@]:1}" -o scenes > list
bplod scenes/m_LOD1.glb "${tileset[@]:1}" -o scenes --overwrite 2>&1
bplod scenes/../scenes/m_LOD2.glb --name n --resolution 24 --levels 1 --profile 3dtiles -q -o scenes --overwrite | cut -f 1
LC_ALL=C ls -A scenes

# What is printed and cannot be written is an error, of the plan and of the list. The files are complete all the same, and it is said.
said "bplod ${options[*]} --explain > /dev/full"
said "bplod ${options[*]} -o full > /dev/full"
said "bplod ${tileset[*]} -o tiles --cache cache > /dev/full"
said "bplod ${tileset[*]} --tiles 0..1 --cache cache > /dev/full"
said "bplod ${options[*]} -o pipe --report pipe.json | true"
LC_ALL=C ls -A full tiles pipe pipe.json
bpcheck cube.obj full/m.glb | tail -1
bpcheck cube.obj tiles | sed 's/[0-9]* triangles/some triangles/'
bplod "${tileset[@]}" --tiles 0..1 --cache cache
said "bplod ${options[*]} -o reported2 --report /dev/full | cut -f 1"
said "bpvox cube.obj --resolution 24 -o full.bpv --report /dev/full && ls full.bpv"
LC_ALL=C ls -A reported2
bpinfo full.bpv | sed -n 1p

# A name must be what JSON can hold; that is said before the work.
latin1=$'caf\xe9'
cp cube.obj "$latin1.obj"
said "bplod $latin1.obj --levels 1 -q -o latin1" | tr '\351' '?'
said "bplod cube.obj --name $latin1 --profile 3dtiles --levels 1 -q -o latin1" | tr '\351' '?'
bplod "$latin1.obj" --name café --levels 1 --resolution 24 -q -o latin1 | cut -f 1

# URIs of a tileset are percent-encoded, so that a viewer asks for the files that are there; and tiles that go are found by them.
odd='a#b?c%20d ü'
bplod cube.obj --name "$odd" --resolution 24 --levels 2 --profile 3dtiles -q -o odd | cut -f 1
grep -o '"uri": .*' odd/tileset.json
bpcheck cube.obj odd/tileset.json | sed 's/[0-9]* triangles/some triangles/'
bplod "${tileset[@]}" -o odd --overwrite > list
LC_ALL=C ls -A odd

# The folder may be a mount or a link to another file system, and its parent read-only: all work is done inside.
elsewhere=$(mktemp -d /dev/shm/bp-golden.XXXXXX 2> /dev/null || mktemp -d)
ln -s "$elsewhere" link
bplod "${tileset[@]}" -o link | cut -f 1
LC_ALL=C ls -A "$elsewhere"
rm -r "$elsewhere" link

# Killed while the files were moved: what was moved is known, and what was to go goes, also under another name.
mkdir -p killed/.partial killed/old_LOD0
touch killed/old_LOD0/0_0_0.glb killed/old_LOD1.glb killed/m_LOD0.glb killed/kept.glb
printf '%s\0' old_LOD0/0_0_0.glb old_LOD1.glb m_LOD0.glb ../cube.obj tileset.json > killed/.partial/moving
cp -r killed killed2
try bplod "${tileset[@]}" -o killed | cut -f 1
LC_ALL=C ls -A killed
cp tiles/tileset.json killed2/
try bplod "${tileset[@]}" -o killed2
try bplod "${tileset[@]}" -o killed2 --overwrite | cut -f 1
LC_ALL=C ls -A killed2
ls cube.obj

# One folder is made, and not those above it. Of one that was made for a run that fails, or that a signal ends, nothing stays.
for profile in gltf 3dtiles; do try bplod cube.obj -o x/y --profile $profile; done
try bplod cube.obj --profile 3dtiles --cache x/y -o tiles-of-cube
try bplod missing.obj -o x
try bplod missing.obj -o x --profile 3dtiles
try bplod cube.obj -o cube.obj/x
mkfifo in
exec 3<> in
for _ in $(seq 40); do  # at whatever moment, from the first folder on
  for profile in gltf 3dtiles; do
    bplod - --format obj --profile $profile -q -o x <&3 > list &
    for ((k = 0; k < 100000; ++k)); do [ -e x ] && break; done
    kill $!
    wait $!
    echo "$profile: $?" $(find x)
  done
done 2> /dev/null | sort | uniq -c | sed 's/^ *//'

# bpcheck answers what was asked of a tileset, or refuses to.
bpcheck cube.obj tiles/tileset.json --json | sed 's/"triangles": [0-9]*/"triangles": SOME/'
rm tiles/m_LOD1.glb
try bpcheck tiles/tileset.json --json | sed 's/"triangles": [0-9]*/"triangles": SOME/'
for option in --inside '--origin 0,0,0'; do
  try bpcheck cube.obj tiles/tileset.json $option
done

# A tileset that cannot be read is replaced; that its tiles stay is said.
mkdir unread
touch unread/gone.glb
echo '{"broken' > unread/tileset.json
try bplod cube.obj --name m --resolution 24 --levels 1 --profile 3dtiles -o unread --overwrite | sed 's/JSON: .*;/JSON;/' | cut -f 1
LC_ALL=C ls -A unread

# The report says what was asked for, and how much was read and written.
bplod cube.obj --name m --faces 60,20 --resolution 24 --profile 3dtiles -q -j 1 --memory 300M -o reported --report report.json > list
sed -n '/"options"/,/^  }/p; /"bytes_in"/p' report.json
stat -c %s cube.obj
[ "$(cat reported/* | wc -c)" = "$(grep -o '"bytes_out": [0-9]*' report.json | grep -o '[0-9]*$')" ] && echo "as many bytes as written"

# Between the levels in one mesh and the tiles there are no nodes without content: a viewer that stopped there would draw nothing.
bp-plant --triangles 10000 -o small.ply > list
bplod small.ply --profile 3dtiles --resolution 300 --tile 64 -q -o deep > list
bpinfo deep/tileset.json | awk '/^depth/ { ++n; if ($5 == 0) print "a hole" } END { print n, "depths with contents" }'
# What is printed as the proof can be run as it is.
cp cube.obj -- "-d it's.obj"
bplod --faces 12 --resolution 24 -o "-out" -- "-d it's.obj" 2> said > list
sed -n 's/.*prove it: //p' said
eval "$(sed -n 's/.*prove it: //p' said)" | tail -1
bpcheck cube.obj cube.obj -q --report report.json > said
sed -n '/"bytes_in"/p' report.json
