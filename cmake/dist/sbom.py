"""Writes the bill of materials of a release: sbom.py DIST VERSION TIME COMPILED_IN IMAGE_STATUS.

SPDX 2.3 [ISO/IEC 5962], as JSON, to DIST/bdpt-VERSION.spdx.json. It lists the files of DIST, and what each contains of
others: archives by their list of libraries, wheels by what auditwheel has noted, the container image by the status of
dpkg (IMAGE_STATUS) and the archive in it. COMPILED_IN lists the Debian packages whose headers were compiled in. TIME is
that of the release, in seconds since 1970.
"""

import datetime
import hashlib
import json
import pathlib
import re
import sys
import tarfile
import urllib.parse
import zipfile


def identifier(*words):
    return "SPDXRef-" + re.sub(r"[^A-Za-z0-9.]+", "-", "-".join(words))


class Bill:
    def __init__(self):
        self.packages = {}
        self.relations = set()

    def add(self, key, name, version, **more):
        self.packages[key] = {
            "SPDXID": key, "name": name, "versionInfo": version, "downloadLocation": "NOASSERTION",
            "filesAnalyzed": False, "licenseConcluded": "NOASSERTION", "licenseDeclared": "NOASSERTION",
            "copyrightText": "NOASSERTION", "supplier": "NOASSERTION", **more}
        return key

    def add_from(self, name, version, purl, **more):
        where = {"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl", "referenceLocator": purl}
        return self.add(identifier(*re.split("[:/@?]", purl)), name, version, externalRefs=[where], **more)

    def add_debian(self, name, version, architecture):
        purl = f"pkg:deb/debian/{name}@{urllib.parse.quote(version, safe='')}?arch={architecture}"
        return self.add_from(name, version, purl, supplier="Organization: Debian")

    def relate(self, one, how, other):
        self.relations.add((one, how, other))


def read_archive(bill, owner, file):
    """The libraries in an archive: lines `FILE: PACKAGE VERSION`, and the two that Debian lacks."""
    architecture = "arm64" if "aarch64" in file.name else "amd64"
    with tarfile.open(file) as tar:
        for entry in tar.getmembers():
            if entry.name.endswith("/share/doc/bdpt/libraries.txt"):
                text = tar.extractfile(entry).read().decode()
                for name, version in re.findall(r"^\S+: (\S+) (\S+)$", text, flags=re.M):
                    bill.relate(owner, "CONTAINS", bill.add_debian(name, version, architecture))
            elif entry.name.endswith("/bdpt/denoiser/README.txt"):
                version = re.search(r"pyoidn (\S+?)\.?$", tar.extractfile(entry).read().decode(), flags=re.M)[1]
                bill.relate(owner, "CONTAINS", bill.add_from(
                    "pyoidn (Open Image Denoise)", version, f"pkg:pypi/pyoidn@{version}", licenseDeclared="Apache-2.0"))
            elif entry.name.endswith("/bdpt/ktx/README.txt"):
                bill.relate(owner, "CONTAINS", add_ktx(bill, tar.extractfile(entry).read().decode()))


def add_ktx(bill, text):
    version = re.search(r"lwjgl-ktx (\S+?)\.?$", text, flags=re.M)[1]
    return bill.add_from("lwjgl-ktx (libktx)", version, f"pkg:maven/org.lwjgl/lwjgl-ktx@{version}",
                         licenseDeclared="Apache-2.0")


def packages_of_archive(file):
    """The Debian packages (NAME, VERSION) of the libraries in an archive, by the names of the libraries up to a dot."""
    with tarfile.open(file) as tar:
        (entry,) = (entry for entry in tar.getmembers() if entry.name.endswith("/share/doc/bdpt/libraries.txt"))
        text = tar.extractfile(entry).read().decode()
    return {library: package for library, *package in re.findall(r"^([^\s.]+)\.\S*: (\S+) (\S+)$", text, flags=re.M)}


def packages_in_wheel(wheel, file):
    """The Debian packages whose libraries are in a wheel. auditwheel has noted them in CycloneDX, but for other
    processors, whose libraries are those of the archive."""
    libraries = [name for name in wheel.namelist() if name.startswith("bdpt.libs/") and ".so" in name]
    if file.name.endswith("aarch64.whl"):
        (archive,) = file.parent.glob("*-linux-aarch64.tar.xz")
        packages = packages_of_archive(archive)
        return [(*packages[re.fullmatch(r"bdpt\.libs/([^.]+)-[0-9a-f]{8}\.\S+", name)[1]], "arm64")
                for name in libraries]
    noted = [name for name in wheel.namelist() if name.endswith("/sboms/auditwheel.cdx.json")]
    assert bool(libraries) == bool(noted), (file, libraries, noted)
    return [(part["name"], part["version"], "amd64") for name in noted
            for part in json.loads(wheel.read(name))["components"] if part["purl"].startswith("pkg:deb/")]


def read_wheel(bill, owner, file):
    with zipfile.ZipFile(file) as wheel:
        for package in packages_in_wheel(wheel, file):
            bill.relate(owner, "CONTAINS", bill.add_debian(*package))
        for name in wheel.namelist():
            if name.endswith("/ktx/README.txt"):
                bill.relate(owner, "CONTAINS", add_ktx(bill, wheel.read(name).decode()))


def read_image(bill, owner, status):
    for paragraph in filter(None, status.split("\n\n")):
        fields = dict(re.findall(r"^(Package|Version|Architecture): (\S+)$", paragraph, flags=re.M))
        bill.relate(owner, "CONTAINS", bill.add_debian(fields["Package"], fields["Version"], fields["Architecture"]))


def main():
    folder, version, time, compiled_in, image_status = sys.argv[1:]
    folder = pathlib.Path(folder)
    target = folder / f"bdpt-{version}.spdx.json"
    bill = Bill()
    source = bill.add(identifier("bdpt"), "bdpt", version, licenseDeclared="Apache-2.0", licenseConcluded="Apache-2.0")
    bill.relate("SPDXRef-DOCUMENT", "DESCRIBES", source)
    for line in pathlib.Path(compiled_in).read_text(encoding="utf-8").splitlines():
        bill.relate(bill.add_debian(*line.split(), "amd64"), "BUILD_DEPENDENCY_OF", source)
    owners = {}
    for file in sorted(folder.iterdir()):
        if file in (target, folder / "SHA256SUMS"):
            continue
        digest = hashlib.sha256(file.read_bytes()).hexdigest()
        owner = owners[file.name] = bill.add(
            identifier("file", file.name), file.name, version, packageFileName=file.name, licenseDeclared="Apache-2.0",
            checksums=[{"algorithm": "SHA256", "checksumValue": digest}])
        bill.relate("SPDXRef-DOCUMENT", "DESCRIBES", owner)
        bill.relate(owner, "GENERATED_FROM", source)
        if "-linux-" in file.name and file.name.endswith(".tar.xz"):
            read_archive(bill, owner, file)
        elif file.suffix == ".whl":
            read_wheel(bill, owner, file)
        elif "-oci-" in file.name:
            read_image(bill, owner, pathlib.Path(image_status).read_text(encoding="utf-8"))
    image, archive = (owners.get(f"bdpt-{version}-{kind}") for kind in ("oci-x86_64.tar", "linux-x86_64.tar.xz"))
    if image and archive:
        bill.relate(image, "CONTAINS", archive)
    created = datetime.datetime.fromtimestamp(int(time), datetime.timezone.utc)
    document = {
        "spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": f"bdpt-{version}",
        "documentNamespace": f"https://bdpt.invalid/spdx/bdpt-{version}-{time}",
        "creationInfo": {"created": created.strftime("%Y-%m-%dT%H:%M:%SZ"), "creators": ["Tool: bdpt-dist"]},
        "packages": [bill.packages[key] for key in sorted(bill.packages)],
        "relationships": [{"spdxElementId": one, "relationshipType": how, "relatedSpdxElement": other}
                          for one, how, other in sorted(bill.relations)]}
    target.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")


main()
