#!/usr/bin/env bash
# Run a command in the lab: run.sh FOLDER COMMAND. The command must not contain a double
# quote. Ends with the exit status of the command, or 99 when it was never reached or has
# not ended after LAB_LIMIT_S seconds.
set -euo pipefail

folder=${1:?usage: run.sh FOLDER COMMAND}
command=${2:?usage: run.sh FOLDER COMMAND}
log=$folder/lab.log
limit_s=${LAB_LIMIT_S:-900}

# Plain emulation: KVM is not to be had on most machines that check.
# icount, sleep=off: the guest's time is the instructions it has run, and jumps over what
# it only waits. A busy host makes it slower but never late, and waiting costs nothing.
# multidevs=remap: without it the files of the guest's own mounts are mixed up with the
# host's, and udev loses its database without a word.
timeout --kill-after=10 "$limit_s" qemu-system-x86_64 \
    -M q35,accel=tcg -cpu max -icount shift=0,sleep=off -smp 1 -m 768 -no-reboot -nic none \
    -display none -vga none -monitor none -serial stdio \
    -kernel "$folder/vmlinuz" -initrd "$folder/initrd.gz" \
    -append "console=ttyS0 quiet panic=-1 mitigations=off tsc=reliable lab=\"$command\"" \
    -fsdev local,id=h,path=/,security_model=none,readonly=on,multidevs=remap \
    -device virtio-9p-pci,fsdev=h,mount_tag=hostroot </dev/null | sed -u 's#\r##g' | tee "$log" |
    grep --line-buffered -v -e '^LAB-EXIT' -e 'vhci_device speed not set' || true
status=$(sed -n 's/^LAB-EXIT //p' "$log")
if [ -z "$status" ]; then
    echo "the lab's guest did not come to its end; after $limit_s s (LAB_LIMIT_S) it is" \
        "stopped. Its last words stand above and in $log" >&2
    exit 99
fi
exit "$status"
