#!/usr/bin/env bash
# Fetches Debian's kernel for the virtual machine of run.sh, and builds v4l2loopback for it. Of
# 85 MB through apt-get download 12 MB are kept, in build/v4l2_vm or $POSELIFT_VM_CACHE; nothing
# is installed. Does nothing when they are there.
set -euo pipefail
cache=$(realpath -m "${POSELIFT_VM_CACHE:-$(dirname "$0")/../../build/v4l2_vm}")
[[ -e $cache/version ]] && exit 0

loaded=(virtio_pci 9pnet_virtio 9p overlay vivid v4l2loopback) # and what they need

image=$(apt-cache depends linux-image-amd64 | awk '/Depends: linux-image-/ {print $2; exit}')
[[ -n $image ]] || { echo "$0: apt knows no linux-image-amd64; apt-get update?" >&2; exit 1; }
version=${image#linux-image-}
mapfile -t headers < <(apt-cache depends "linux-headers-$version" |
  awk '/Depends: linux-(headers|kbuild)-/ {print $2}')

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
chmod 755 "$work"
cd "$work"
apt-get -qq -o APT::Sandbox::User=root download "$image" "linux-headers-$version" "${headers[@]}" v4l2loopback-dkms
mkdir kernel build
for package in *.deb; do
  case $package in
    linux-image-*) dpkg-deb -x "$package" kernel ;;
    *) dpkg-deb -x "$package" build ;;
  esac
  rm "$package"
done

# The headers name their common part by its place in the system.
kbuild=$work/build/usr/src/linux-headers-$version
sed -i "s#/usr/src/#$work/build/usr/src/#" "$kbuild/Makefile"
cp -r build/usr/src/v4l2loopback-* loopback
make -s -C "$kbuild" M="$work/loopback" modules
install -D loopback/v4l2loopback.ko "kernel/lib/modules/$version/extra/v4l2loopback.ko"
strip -g "kernel/lib/modules/$version/extra/v4l2loopback.ko"
depmod -b kernel "$version"

rm -rf "$cache"
for module in "${loaded[@]}"; do
  modprobe -d "$work/kernel" -S "$version" --show-depends "$module"
done | awk '$1 == "insmod" {print $2}' | sort -u | while read -r file; do
  install -D -m 644 "$file" "$cache/${file#"$work/kernel/"}"
done
cp kernel/lib/modules/"$version"/modules.{order,builtin,builtin.modinfo} \
  "$cache/lib/modules/$version/"
depmod -b "$cache" "$version"
install -m 644 "kernel/boot/vmlinuz-$version" "$cache/vmlinuz"
echo "$version" >"$cache/version"
