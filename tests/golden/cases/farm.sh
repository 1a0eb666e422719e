# The farm on this machine: the same files and table as the nightly sample, tilesets in parts; a broken scene does not stop the others.
command -v snakemake > /dev/null || { echo "there is no snakemake" && exit 77; }
mkdir "{scenes}"
for i in 0 2; do
  write_cube cube.obj 3
  sed "s/^v \(.*\) \(.*\) \(.*\)$/echo v \$((\1 + 7 * $i)) \2 \$((\3 + $i))/e" cube.obj > "{scenes}/part {$i}.obj"
done
echo "v 1 2" > "{scenes}/broken.obj"
export BATCH=0.01 MACHINES=2 WAIT=0 MEMORY=500M THREADS=1 SNAKEMAKE=-c2
table() { sed "s/made in [0-9]* s/made/; s|$PWD/||" | cut -f 1-3; }
farm() { "$BP_ROOT/samples/farm/night" "{scenes}" "o {ut}" "$@" | table; }
options=(--voxel 0.022 --tile 128 --levels 2 --profile 3dtiles --name "it's")
"$BP_ROOT/samples/nightly" "$PWD/{scenes}" serial "${options[@]}" 2> /dev/null | table > table
farm "${options[@]}"
diff table <(table < "o {ut}/report.tsv") && echo "the same table"
diff -r -x .cache -x .farm -x 'report.*' -x '.*.log' -x picture.png serial "o {ut}" && echo "the same files"
grep -c "^rule tiles" "o {ut}/.farm/log/snakemake"
grep -c "^rule check" "o {ut}/.farm/log/snakemake"
grep -o 'mem_mb=[0-9]*' "o {ut}/.farm/log/snakemake" | sort -u
grep -o '<img[^>]*>\|[0-9]* made, .* gone\|class="failed"' "o {ut}/report.html"
# Nothing is made twice; after a change only that scene.
farm "${options[@]}"
grep -c "^rule tiles" "o {ut}/.farm/log/snakemake"
write_cube "{scenes}/part {2}.obj" 4
farm "${options[@]}"
grep -o '([-+][0-9,]*)' "o {ut}/report.html" | head -1 # what changed
# A part of the check that fails keeps the old levels; one on a machine that fails is done again.
mkdir bin
cat > bin/bpcheck << 'SCRIPT'
#!/bin/sh
case $* in
  *"--part 1/2"*"{2}.obj"*) [ -f tried ] || { touch tried && exit 4; } ;;
  *"--part 2/2"*"{2}.obj"*) [ -f mended ] || { echo "a finding" && exit 1; } ;;
esac
SCRIPT
echo "exec $(command -v bpcheck) \"\$@\"" >> bin/bpcheck && chmod +x bin/bpcheck
cp -r "o {ut}/part {2}.obj" old
write_cube "{scenes}/part {2}.obj" 5
PATH=$PWD/bin:$PATH farm "${options[@]}"
grep -c "Error in rule check" "o {ut}/.farm/log/snakemake"
diff -r old "o {ut}/part {2}.obj" && echo "the old levels"
touch "o {ut}/.farm/mended"
PATH=$PWD/bin:$PATH farm "${options[@]}"
# What nobody checked replaces nothing.
nightly() { "$BP_ROOT/samples/nightly" "$@" --name cubes --voxel 0.022 --tile 128 --levels 2 --profile 3dtiles; }
write_cube one.obj 3
nightly --make one.obj steps
nightly --check 1/2 one.obj steps
nightly --take 0 one.obj steps
ls steps
nightly --take 2 one.obj steps 2> /dev/null || echo "= $?"
ls steps
# Each job has GPUs of its own.
printf '#!/bin/sh\necho "GPU 0: one"\necho "GPU 1: two"\n' > bin/nvidia-smi && chmod +x bin/nvidia-smi
on_gpus() { PATH=$PWD/bin:$PATH "$BP_ROOT/samples/farm/on_gpus" "$@"; }
unset CUDA_VISIBLE_DEVICES
for i in 1 2 3 4 5; do
  on_gpus 1 sh -c 'mkdir "gpu $CUDA_VISIBLE_DEVICES" && sleep 0.2 && rmdir "gpu $CUDA_VISIBLE_DEVICES" && echo one' >> gpus &
done
on_gpus 2 sh -c 'mkdir "gpu 0" "gpu 1" && echo "$CUDA_VISIBLE_DEVICES" && rmdir "gpu 0" "gpu 1"' >> gpus &
wait
sort gpus
CUDA_VISIBLE_DEVICES=5 on_gpus 1 sh -c 'echo $CUDA_VISIBLE_DEVICES'
try on_gpus 3 true
try env MACHINES=many "$BP_ROOT/samples/farm/night" "{scenes}" "o {ut}" | sed "s|$BP_ROOT/||"
try "$BP_ROOT/samples/farm/night" nowhere out | sed "s|$BP_ROOT/||"
