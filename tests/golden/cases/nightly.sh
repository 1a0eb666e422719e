# The nightly sample: only what changed is made again, a broken scene does not stop the others, what is gone goes.
mkdir scenes
write_ball scenes/a.obj 3
write_ball "scenes/b c.obj" 2
echo "v 1 2" > scenes/broken.obj
echo "no scene" > scenes/notes.txt
nightly() { "$BP_ROOT/samples/nightly" "$@" 2> as-it-goes; }
table() { sed 's/made in [0-9]* s/made/' | cut -f 1-3; }
options=(--faces 60,20 --resolution 24 --profile 3dtiles)
nightly scenes out "${options[@]}" | table
sed 's/made in [0-9]* s/made/' as-it-goes  # a line per scene
nightly scenes out "${options[@]}" | table
nightly scenes out -j 1 --memory=1G "${options[@]}" --temp . --progress json | table  # no byte differs
nightly scenes out "${options[@]}" --enclose input | table
nightly scenes out "${options[@]}" -q | table
write_ball scenes/a.obj 4
rm "scenes/b c.obj" scenes/broken.obj
sed -i '1i mtllib paints.mtl' scenes/a.obj  # what a scene names counts, whatever it is called
for red in 0.1 0.9 0.9; do
  printf 'newmtl paint\nKd %s 0 0\n' $red > scenes/paints.mtl
  nightly scenes out "${options[@]}" | table
done
nightly scenes out "${options[@]}" | table
nightly scenes out --faces 60,20 --resolution 24 | table
LC_ALL=C ls -A out out/a.obj
for options in "--profile collision --faces 60" "--mode fit --faces 60" "--mode fit --profile 3dtiles --faces 60"; do
  nightly scenes out $options --resolution 24 | table
done
# The proof keeps to the same memory and threads; if it runs out of memory, that is the machine's fault, and not the scene's.
mkdir bin
printf '#!/bin/bash\necho "$@" >> checks\necho "an answer of bpcheck"\nexit ${ENDS:-4}\n' > bin/bpcheck
chmod +x bin/bpcheck
for ends in 4 5; do
  ENDS=$ends PATH=$PWD/bin:$PATH nightly --one scenes/a.obj out --faces 61 --resolution 24 -j1 --memory 900M --temp=.
  echo "= $?"
  sed 's/made in [0-9]* s/made/' as-it-goes
done
nightly scenes out --faces 61 --resolution 24 | cut -f 1,2  # nor is it the next night
# What is refuted is not taken, whatever was not decided before it.
printf '#!/bin/bash\ncase $* in *.glb) echo "$@" >> asked; exit $((6 - 1 - 4 * ($(wc -l < asked) - 1)));; esac\n' > bin/bpcheck
PATH=$PWD/bin:$PATH nightly --one scenes/a.obj out --faces 60,30 --resolution 24
echo "= $?"
wc -l < asked
cat checks
try "$BP_ROOT/samples/nightly" nowhere out | sed "s|$BP_ROOT/||"
