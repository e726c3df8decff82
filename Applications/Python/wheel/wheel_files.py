"""A folder as a wheel's file."""

import base64
import hashlib
import zipfile


def write(folder, path):
    """Writes `folder`, which holds a *.dist-info, with a RECORD of its own; the same content gives the same bytes."""
    record = next(folder.glob("*.dist-info")) / "RECORD"
    record.unlink(missing_ok=True)
    files = sorted(file for file in folder.rglob("*") if file.is_file())
    lines = []
    for file in files:
        digest = base64.urlsafe_b64encode(hashlib.sha256(file.read_bytes()).digest()).rstrip(b"=").decode()
        lines.append(f"{file.relative_to(folder)},sha256={digest},{file.stat().st_size}\n")
    record.write_text("".join(lines) + f"{record.relative_to(folder)},,\n")
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for file in [*files, record]:
            entry = zipfile.ZipInfo(str(file.relative_to(folder)), (1980, 1, 1, 0, 0, 0))
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o755 if file.suffix == ".so" or ".so." in file.name else 0o644) << 16
            archive.writestr(entry, file.read_bytes())
