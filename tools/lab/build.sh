#!/usr/bin/env bash
# Build the kernel and the first file system of the lab in a folder: build.sh FOLDER.
# Debian 12, x86-64. Needs what .ci/run installs for the lab; no root.
set -euo pipefail

folder=${1:?usage: build.sh FOLDER}
here=$(cd "$(dirname "$0")" && pwd)
rules=$here/../../config/60-paintlink.rules
PATH=$PATH:/usr/sbin:/sbin
for program in qemu-system-x86_64 busybox cpio depmod strip apt-get dpkg; do
    command -v "$program" >/dev/null || {
        echo "the lab needs $program: .ci/run lists the Debian packages" >&2
        exit 2
    }
done
mkdir -p "$folder"
cd "$folder"

modules=(
    virtio_pci 9pnet_virtio 9p                  # the host's files
    usbserial ftdi_sio ch341 cdc-acm            # what makes ttyUSB and ttyACM
    usbip-core vhci-hcd                         # where simulated devices are plugged in
)

package=$(apt-cache depends linux-image-amd64 |
    awk '/Depends: linux-image-[0-9]/ { print $2; exit }')
version=${package#linux-image-}
if [ ! -e kernel/lib/modules/$version/modules.dep ] || [ ! -e vmlinuz ]; then
    rm -rf kernel udev ./*.deb
    # By name from the mirrors of this machine; root may write where user _apt may not.
    apt-get download -qq -o APT::Sandbox::User=root "$package" udev
    tree=./lib/modules/$version
    dpkg --fsys-tarfile "$package"_*.deb | tar x --one-top-level=kernel \
        "./boot/vmlinuz-$version" \
        "$tree/modules.order" "$tree/modules.builtin" "$tree/modules.builtin.modinfo" \
        "$tree/kernel/drivers/usb" "$tree/kernel/drivers/virtio" \
        "$tree/kernel/fs/9p" "$tree/kernel/fs/fscache" "$tree/kernel/fs/netfs" \
        "$tree/kernel/net/9p"
    depmod -b kernel "$version" 2>/dev/null
    dpkg -x udev_*.deb udev
    cp "kernel/boot/vmlinuz-$version" vmlinuz
    rm -f ./*.deb
fi

rm -rf root
mkdir -p root/{bin,modules,mnt,proc,sys,dev,udev}
cp "$(command -v busybox)" root/bin/busybox
for module in "${modules[@]}"; do
    line=$(grep "/$module\.ko:" "kernel/lib/modules/$version/modules.dep") ||
        { echo "the kernel $version has no module $module" >&2; exit 1; }
    # A line names the module and then what it needs: load from its end.
    for file in $(echo "$line" | tr ': ' '\n\n' | tac); do
        name=${file##*/}
        [ -e "root/modules/$name" ] && continue
        strip --strip-debug -o "root/modules/$name" "kernel/lib/modules/$version/$file"
        echo "$name" >>root/modules/order
    done
done
cp udev/bin/udevadm root/udev/systemd-udevd # one program, told apart by its name
cp udev/lib/udev/rules.d/{50-udev-default,60-serial}.rules "$rules" root/udev/
install -m 755 "$here/init" root/init
(cd root && find . | cpio -o -H newc --quiet | gzip -1) >initrd.gz
