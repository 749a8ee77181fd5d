#!/usr/bin/env bash
# Runs a command as root in a small virtual machine that has the files of this one (what it writes
# to them is forgotten), Debian's kernel and its virtual cameras; exits as the command does.
#   run.sh SECONDS COMMAND...     SECONDS: at most
# Exits with 77 where that cannot be. By emulation alone: no KVM is needed.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
cache=$(realpath -m "${POSELIFT_VM_CACHE:-$here/../../build/v4l2_vm}")
seconds=$1
shift

for program in qemu-system-x86_64 busybox cpio; do
  command -v $program >/dev/null || { echo "skipped: there is no $program"; exit 77; }
done
[[ -e $cache/version ]] ||
  { echo "skipped: no kernel in $cache; run tests/v4l2_vm/fetch_kernel.sh"; exit 77; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
chmod 755 "$work"
mkdir -p "$work"/initrd/{bin,proc,sys,dev,host,memory,root} "$work/share"
cp "$(command -v busybox)" "$work/initrd/bin/busybox"
cp -r "$cache/lib" "$here/init" "$work/initrd"
(cd "$work/initrd" && find . | cpio --quiet -o -H newc) >"$work/initrd.cpio"
printf '%q ' env POSELIFT_VM_CACHE="$cache" "$@" >"$work/share/run"

timeout "$seconds" qemu-system-x86_64 -M q35 -accel tcg,thread=multi -cpu max -smp 2 -m 2048 \
  -nodefaults -no-user-config -display none -no-reboot -serial stdio \
  -kernel "$cache/vmlinuz" -initrd "$work/initrd.cpio" \
  -append "console=ttyS0 loglevel=2 panic=-1 mitigations=off nokaslr tsc=reliable no_timer_check" \
  -fsdev local,id=host,path=/,security_model=none,readonly=on,multidevs=remap \
  -device virtio-9p-pci,fsdev=host,mount_tag=host \
  -fsdev local,id=share,path="$work/share",security_model=none,multidevs=remap \
  -device virtio-9p-pci,fsdev=share,mount_tag=share </dev/null | tr -d '\r' || true
[[ -e $work/share/code ]] ||
  { echo "the machine did not end by itself within $seconds s" >&2; exit 125; }
exit "$(<"$work/share/code")"
