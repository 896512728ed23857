"""Archives whose bytes depend on nothing but names and contents: sorted, one time, no owner."""
import gzip
import hashlib
import io
import pathlib
import subprocess
import tarfile
import time
import zipfile


def sha256(file: pathlib.Path) -> str:
    return hashlib.sha256(file.read_bytes()).hexdigest()


def packed(bytes_: bytes, epoch: int = 0) -> bytes:
    """By gzip, without a name in it."""
    out = io.BytesIO()
    with gzip.GzipFile(filename="", mode="wb", fileobj=out, compresslevel=9, mtime=epoch) as file:
        file.write(bytes_)
    return out.getvalue()


def tar_gz(target: pathlib.Path, folder: pathlib.Path, prefix: str, epoch: int) -> None:
    """All of `folder` under `prefix`; links stay links."""
    out = io.BytesIO()
    with tarfile.open(fileobj=out, mode="w", format=tarfile.PAX_FORMAT) as tar:
        for file in sorted(folder.rglob("*")):
            if file.is_dir() and not file.is_symlink():
                continue
            info = tar.gettarinfo(file, f"{prefix}/{file.relative_to(folder)}")
            info.mtime, info.uid, info.gid, info.uname, info.gname = epoch, 0, 0, "", ""
            if info.isreg():
                info.mode = 0o755 if info.mode & 0o100 else 0o644
                with file.open("rb") as content:
                    tar.addfile(info, content)
            else:
                info.mode = 0o777
                tar.addfile(info)
    target.write_bytes(packed(out.getvalue()))


def zip_of(target: pathlib.Path, folder: pathlib.Path, names: list, epoch: int) -> None:
    """These files of `folder`, in this order."""
    when = time.gmtime(max(epoch, 315532800))[:6]  # a zip knows no time before 1980
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name in names:
            file = folder / name
            info = zipfile.ZipInfo(name, when)
            info.compress_type = zipfile.ZIP_DEFLATED
            info.external_attr = (0o100755 if file.stat().st_mode & 0o100 else 0o100644) << 16
            archive.writestr(info, file.read_bytes())


def commit(root: pathlib.Path, prefix: str) -> bytes:
    """The tar of what is committed; its times are the commit's."""
    return subprocess.run(["git", "-C", str(root), "archive", "--format=tar", f"--prefix={prefix}/", "HEAD"], check=True,
                          capture_output=True).stdout
