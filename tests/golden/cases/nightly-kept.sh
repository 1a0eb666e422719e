# The nightly sample and the farm replace and remove nothing that they did not make, and say at once what is wrong with folders and options.
mkdir scenes bin
write_cube scenes/cube.off.obj 3
printf '%s\n' OFF "4 4 0" "0 0 0" "3 0 0" "0 3 0" "0 0 3" "3 0 2 1" "3 0 1 3" "3 1 2 3" "3 2 0 3" > scenes/tetra.off
chmod a-w scenes/tetra.off
cp -r scenes before
night="$BP_ROOT/samples/nightly"
options=(--faces 12 --levels 1 --resolution 24 -j 1)
tried() { try "$@" 2>&1 | sed "s|$BP_ROOT/||; s/made in [0-9]* s/made/"; }
kept() { diff -r before scenes && echo "the scenes are kept"; }
# Levels never take the place of scenes, however the folders are called.
ln -s scenes link
tried "$night" scenes scenes "${options[@]}"
tried "$night" scenes link/ "${options[@]}"
(cd scenes && tried "$night" . ../link "${options[@]}")
for step in "--one scenes/tetra.off" "--make scenes/tetra.off" "--part 0..1 scenes/tetra.off" "--check 1/1 scenes/tetra.off" "--take 1 scenes/tetra.off" "--report scenes"; do
  tried "$night" $step link
done
kept
# Of scenes in a folder where levels go, too.
mkdir -p nested/tetra.off && cp scenes/tetra.off nested/tetra.off
tried "$night" nested/tetra.off nested "${options[@]}"
ls nested/tetra.off
tried "$night" link out "${options[@]}"
cp scenes/tetra.off out/cube.off.obj
tried "$night" out/cube.off.obj out "${options[@]}"
LC_ALL=C ls -A out
# What somebody else put where levels go stays, with what lies in it; so does what has the name of levels that are gone.
rm -r out && mkdir -p out/cube.off.obj out/gone.obj out/key.obj out/.cache/ab out/copy
echo mine | tee out/cube.off.obj/precious.txt out/gone.obj/precious.txt out/key.obj/.key out/tetra.off out/.cache/ab/precious.txt out/.x.status out/.lock > /dev/null
touch -a -d "2 months ago" out/.cache/ab/precious.txt
printf '%064d\n' 0 | tee out/copy/.key > /dev/null
cp -r out mine
tried "$night" scenes out "${options[@]}"
diff -r mine out && echo "nothing is lost"
rm out/tetra.off && mkdir elsewhere && ln -s ../elsewhere out/tetra.off && touch elsewhere/precious.txt
cp out/copy/.key elsewhere
tried "$night" --one scenes/tetra.off out "${options[@]}"
"$night" --plan 2 scenes/tetra.off out "${options[@]}"
ls elsewhere
# The place is taken while levels are made.
rm out/tetra.off
"$night" --make scenes/tetra.off out "${options[@]}" && "$night" --check 1/1 scenes/tetra.off out "${options[@]}" && mkdir out/tetra.off
"$night" --take 1 scenes/tetra.off out
cat out/.tetra.off.status
LC_ALL=C ls -A out out/tetra.off
# Levels that a crash left aside come back; what it left half made or half removed goes.
rm -r out
"$night" scenes out "${options[@]}" 2> /dev/null > /dev/null
mv out/tetra.off out/.tetra.off.old && mkdir out/.tetra.off.new
tried "$night" scenes out "${options[@]}"
LC_ALL=C ls -A out
# Files beside the levels.
echo "my list" > out/report.tsv
tried "$night" scenes out "${options[@]}"
cat out/report.tsv && rm out/report.tsv
ln -s "$(type -P true)" bin/snakemake
farm() { PATH=$PWD/bin:$PATH tried "$BP_ROOT/samples/farm/night" "$@" | sed "s|$PWD|FOLDER|g"; }
echo "my page" > out/report.html
farm scenes out "${options[@]:0:6}"
cat out/report.html
farm scenes link/
farm scenes new --facez 5
kept
# Options that are wrong are told once, and nothing is made; folders that are not there are called so.
for wrong in "--facez 5" "--memory 40M" "-o x" "--output=x" "--cache x" "--explain" "--help" "--faces 12 nosuch.obj" "--progress json --faces"; do
  tried "$night" scenes new $wrong
done
tried "$night" nosuch new
tried "$night" scenes/tetra.off new
tried "$night" scenes scenes/tetra.off
tried "$night" scenes
files
