# A signal ends the work, and the unfinished file goes with it.
for signal in INT TERM HUP; do
  # Background jobs ignore SIGINT, so a fresh process group has to set it back: env does.
  env --default-signal=INT bp-plant --triangles 50000000 -o plant.ply &
  for _ in $(seq 1000); do [ -n "$(ls -A)" ] && break; sleep 0.01; done
  kill -s $signal $!
  wait $!
  echo "$signal: $?"
  files
done 2> /dev/null
# A process that is killed cannot clean up: the next one takes over what it left.
bp-plant --triangles 50000000 -o plant.ply 2> /dev/null &
for _ in $(seq 1000); do [ -n "$(ls -A)" ] && break; sleep 0.01; done
kill -9 $!
wait $! 2> /dev/null
files
bp-plant --triangles 10000 -o plant.ply > list
files
