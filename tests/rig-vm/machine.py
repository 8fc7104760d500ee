#!/usr/bin/env python3
"""Starts a virtual machine with Debian's kernel, in it the suites of tests/rig-vm, and brings their results back.

    machine.py WORK SOURCE_DIR SUITE… -- PROGRAM…

WORK keeps the kernel between calls (WORK/kernel) and takes what the suites say: WORK/out/SUITE.xml (JUnit), WORK/out/measured.txt, and the machine's
console. The first program has the suites. Nothing is installed, no right is needed. Exit status: 0 all suites have run, whatever they found; 1 the machine
died or hung; 77 there is no QEMU or no kernel package here.

The machine counts its instructions (one a nanosecond), and its clock is that count: it waits for nothing that sleeps, and a host that is busy with other
things makes it neither faster nor slower by its own clock. So its suites may measure times.
"""
import lzma
import os
import pathlib
import re
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).parent
PATH = os.environ.get("PATH", "") + ":/usr/sbin:/sbin"
# Required modules; modprobe knows their dependencies.
MODULES = ("virtio_pci 9pnet_virtio 9p configfs vcan can_raw uhid hid_generic usbhid dummy_hcd usb_f_fs evdev uinput veth sch_netem kvaser_pci "
           "snd_aloop snd_dummy").split()
UNPACKED = ("boot/vmlinuz*", "lib/modules/*/modules.*", "lib/modules/*/kernel/crypto/*", "lib/modules/*/kernel/fs/*", "lib/modules/*/kernel/lib/*",
            "lib/modules/*/kernel/net/*", "lib/modules/*/kernel/drivers/hid/*", "lib/modules/*/kernel/drivers/input/*",
            "lib/modules/*/kernel/drivers/net/*", "lib/modules/*/kernel/drivers/usb/*", "lib/modules/*/kernel/drivers/virtio/*",
            "lib/modules/*/kernel/sound/soundcore.ko", "lib/modules/*/kernel/sound/core/*", "lib/modules/*/kernel/sound/drivers/*")
# Files that ALSA's library reads before it knows a card.
ALSA_SETTINGS = pathlib.Path("/usr/share/alsa")
COMMAND_LINE = "console=ttyS0 quiet panic=-1 tsc=reliable no_timer_check mitigations=off random.trust_cpu=1"
ALL_SUITES_RAN = 33  # QEMU's exit status for the 16 that init writes to its debug port.
LIMIT_S = 900


class Missing(Exception):
    """This machine lacks the requirements."""


def output_of(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True, env={**os.environ, "PATH": PATH, "LC_ALL": "C"}).stdout


def tool(name):
    found = shutil.which(name, path=PATH)
    if not found:
        raise Missing(f"there is no {name}: install the packages of .ci/packages.txt")
    return found


def kernel_package():
    """The name of Debian's newest kernel package; its lists are renewed where there are none and this user may."""
    for attempt in range(2):
        try:
            for line in output_of("apt-cache", "depends", "linux-image-amd64").splitlines():
                if found := re.fullmatch(r"\s*Depends: (linux-image-\d\S*)", line):
                    return found[1]
        except (subprocess.CalledProcessError, FileNotFoundError):
            pass
        if attempt == 0 and os.geteuid() == 0 and shutil.which("apt-get"):
            subprocess.run(["apt-get", "update", "-qq"], check=False)
    raise Missing("apt knows no package linux-image-amd64: the suites need Debian's kernel")


def kernel(work):
    """The folder with Debian's kernel (vmlinux) and its modules (root/lib/modules), fetched and unpacked where it is not there yet."""
    package = kernel_package()
    folder = work / "kernel" / package
    kept = folder / "unpacked.txt"  # Of which of its parts there are.
    if kept.exists() and kept.read_text() == "\n".join(UNPACKED):
        return folder
    shutil.rmtree(folder, ignore_errors=True)
    root = folder / "root"
    root.mkdir(parents=True)
    fetched = subprocess.run(["apt-get", "download", "-qq", "-o", "APT::Sandbox::User=root", package], cwd=folder, capture_output=True, text=True)
    packages = list(folder.glob("*.deb"))
    if fetched.returncode != 0 or not packages:
        raise Missing(f"{package} cannot be fetched: {fetched.stderr.strip()}")
    unpack = subprocess.Popen(["dpkg-deb", "--fsys-tarfile", packages[0]], stdout=subprocess.PIPE)
    subprocess.run(["tar", "-x", "-C", root, "--wildcards", *("./" + name for name in UNPACKED)], stdin=unpack.stdout, check=True)
    if unpack.wait() != 0:
        raise RuntimeError(f"{packages[0].name} cannot be unpacked")
    packages[0].unlink()
    version = package.removeprefix("linux-image-")
    subprocess.run([tool("depmod"), "-b", root, version], check=True)
    # QEMU starts an unpacked kernel sooner than one that unpacks itself.
    packed = next((root / "boot").glob("vmlinuz*")).read_bytes()
    unpacked = lzma.LZMADecompressor(format=lzma.FORMAT_XZ).decompress(packed[packed.index(bytes.fromhex("fd377a585a00")):])
    (folder / "part").write_bytes(unpacked)
    (folder / "part").rename(folder / "vmlinux")
    kept.write_text("\n".join(UNPACKED))
    return folder


def modules(folder):
    """Their files, each after those that it needs."""
    version = folder.name.removeprefix("linux-image-")
    files = []
    for name in MODULES:
        shown = output_of(tool("modprobe"), "-S", version, "-d", str(folder / "root"), "--show-depends", name)
        files += [line.split()[1] for line in shown.splitlines() if line.startswith("insmod")]
    return [pathlib.Path(file) for file in dict.fromkeys(files)]


def libraries(programs):
    found = set()
    for program in programs:
        found |= set(re.findall(r"(/\S+) \(0x", output_of("ldd", program)))
    return found


def make_initramfs(image, files, suites, programs):
    """busybox, ip and tc, the modules, the programs in /bin with their libraries where they lie here."""
    root = image.parent / "initramfs"
    shutil.rmtree(root, ignore_errors=True)
    for folder in ("bin", "modules"):
        (root / folder).mkdir(parents=True)
    shutil.copy(HERE / "init", root / "init").chmod(0o755)
    shutil.copy(tool("busybox"), root / "bin")
    tools = [tool("ip"), tool("tc")]
    for file in files:
        shutil.copy(file, root / "modules")
    (root / "modules/order").write_text("".join(f"{file.name}\n" for file in files))
    (root / "suites").write_text("".join(f"{suite}\n" for suite in suites))
    for program in programs:
        subprocess.run(["strip", "-o", root / "bin" / pathlib.Path(program).name, program], check=True)
    (root / "bin" / pathlib.Path(programs[0]).name).rename(root / "bin/suites")
    for file in [*tools, *libraries([*tools, *programs])]:
        target = root / (file if file not in tools else f"tools/{pathlib.Path(file).name}").lstrip("/")
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(file, target)
    if ALSA_SETTINGS.exists():
        shutil.copytree(ALSA_SETTINGS, root / str(ALSA_SETTINGS).lstrip("/"), ignore=shutil.ignore_patterns("ucm*", "topology"))
    names = "\n".join(str(path.relative_to(root)) for path in sorted(root.rglob("*")))
    with open(image, "wb") as made:
        subprocess.run([tool("busybox"), "cpio", "-o", "-H", "newc"], cwd=root, input=names.encode(), stdout=made, stderr=subprocess.DEVNULL, check=True)
    shutil.rmtree(root)


def boot(folder, image, source, out):
    share = "local,security_model=none,id={0},path={1}{2}"
    console = out / "console.txt"
    with open(console, "wb") as log:
        try:
            return subprocess.run(
                [tool("qemu-system-x86_64"), "-machine", "pc", "-accel", "tcg,tb-size=256", "-icount", "shift=0,sleep=off", "-cpu", "max", "-smp", "1",
                 "-m", "1024", "-nodefaults", "-display", "none", "-serial", "stdio", "-no-reboot", "-kernel", folder / "vmlinux", "-initrd", image,
                 # Two controllers of one CAN bus.
                 "-object", "can-bus,id=bus", "-device", "kvaser_pci,canbus=bus", "-device", "kvaser_pci,canbus=bus",
                 "-append", COMMAND_LINE, "-device", "isa-debug-exit,iobase=0xf4,iosize=4",
                 "-fsdev", share.format("out", out, ""), "-device", "virtio-9p-pci,fsdev=out,mount_tag=out",
                 "-fsdev", share.format("source", source, ",readonly=on"), "-device", "virtio-9p-pci,fsdev=source,mount_tag=source"],
                stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT, timeout=LIMIT_S).returncode
        except subprocess.TimeoutExpired:
            return f"none after {LIMIT_S} s"


def main(work, source, suites, programs):
    out = work / "out"
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    try:
        for name in ("busybox", "ip", "tc", "modprobe", "depmod", "qemu-system-x86_64"):
            tool(name)
        folder = kernel(work)
    except Missing as what:
        print(f"skipped: {what}")
        (out / "skipped.txt").write_text(f"{what}\n")
        return 77
    make_initramfs(work / "initramfs.img", modules(folder), suites, programs)
    status = boot(folder, work / "initramfs.img", source, out)
    print((out / "console.txt").read_text(errors="replace"))
    measured = out / "measured.txt"
    if measured.exists():
        print(measured.read_text())
    if status != ALL_SUITES_RAN:
        print(f"the machine died: exit status {status}, {ALL_SUITES_RAN} expected")
        return 1
    return 0


if __name__ == "__main__":
    arguments = sys.argv[1:]
    middle = arguments.index("--")
    sys.exit(main(pathlib.Path(arguments[0]).resolve(), pathlib.Path(arguments[1]), arguments[2:middle], arguments[middle + 1:]))
