"""The Unity package: a tarball for the Package Manager. Unity knows an asset by the number in its .meta file; here it follows from
the asset's path, so that it is the same in every release, and scenes that use the package keep working."""
import hashlib
import json
import pathlib
import shutil
import tempfile

from release import archives, c_library, licences, notes, shared_objects
from release.basics import ROOT, Release

SOURCE = ROOT / "packaging/unity"
NAME = "org.palpate.unity"
SCRIPT = "Samples~/FirstTouch/FirstTouch.cs"
FOLDER = "folderAsset: yes\nDefaultImporter:\n  externalObjects: {}\n"
IMPORTERS = {
    ".cs": "MonoImporter:\n  externalObjects: {}\n  serializedVersion: 2\n  defaultReferences: []\n  executionOrder: 0\n  icon: {instanceID: 0}\n",
    ".asmdef": "AssemblyDefinitionImporter:\n  externalObjects: {}\n",
    ".md": "TextScriptImporter:\n  externalObjects: {}\n",
    ".json": "PackageManifestImporter:\n  externalObjects: {}\n",
    ".unity": "DefaultImporter:\n  externalObjects: {}\n",
}
LAST = "  userData: \n  assetBundleName: \n  assetBundleVariant: \n"
PLUGIN = """PluginImporter:
  externalObjects: {{}}
  serializedVersion: 2
  iconMap: {{}}
  executionOrder: {{}}
  defineConstraints: []
  isPreloaded: 0
  isOverridable: 0
  isExplicitlyReferenced: 0
  validateReferences: 1
  platformData:
  - first:
      Any: 
    second:
      enabled: 0
      settings: {{}}
{platforms}"""
PLATFORM = """  - first:
      {platform}
    second:
      enabled: {enabled}
      settings:
        CPU: {cpu}
{more}"""
EDITOR, WINDOWS, LINUX, EMBEDDED = "Editor: Editor", "Standalone: Win64", "Standalone: Linux64", "EmbeddedLinux: EmbeddedLinux"
# Platform -> processor, of what lies in a folder; the rest is off.
PLUGINS = {("x86_64", ".dll"): {EDITOR: "x86_64", WINDOWS: "x86_64"}, ("x86_64", ".so"): {EDITOR: "x86_64", LINUX: "x86_64"},
           ("arm64", ".so"): {EMBEDDED: "ARM64"}}


def guid(path: str) -> str:
    return hashlib.md5(f"{NAME}/{path}".encode()).hexdigest()


def plugin(path: pathlib.PurePosixPath) -> str:
    """The settings of a library: where it is taken along."""
    on = PLUGINS[path.parent.name, path.suffix]
    platforms = ""
    for platform in (EDITOR, WINDOWS, LINUX, EMBEDDED):
        more = ""
        if platform == EDITOR:
            system = "Windows" if path.suffix == ".dll" else "Linux"
            more = f"        DefaultValueInitialized: true\n        OS: {system if EDITOR in on else 'None'}\n"
        platforms += PLATFORM.format(platform=platform, enabled=int(platform in on), cpu=on.get(platform, "None"), more=more)
    return PLUGIN.format(platforms=platforms)


def meta(path: str, is_folder: bool) -> str:
    pure = pathlib.PurePosixPath(path)
    importer = FOLDER if is_folder else plugin(pure) if pure.suffix in (".so", ".dll") else IMPORTERS[pure.suffix]
    return f"fileFormatVersion: 2\nguid: {guid(path)}\n{importer}{LAST}"


def fill_scene(package: pathlib.Path) -> None:
    """A scene knows its scripts by their numbers."""
    scene = (package / SCRIPT).with_suffix(".unity")
    scene.write_text(scene.read_text().replace("@GUID of FirstTouch.cs@", guid(SCRIPT)))


def write_metas(package: pathlib.Path) -> None:
    """One beside every asset. Unity does not look into a folder whose name ends in ~; what is in it becomes assets when it is copied."""
    for file in sorted(package.rglob("*")):
        if file.name.endswith("~"):
            continue
        path = file.relative_to(package).as_posix()
        (file.parent / f"{file.name}.meta").write_text(meta(path, file.is_dir()))


def bring_plugins(release: Release, plugins: pathlib.Path, notices: pathlib.Path) -> str:
    """The library for every system. Gives the glibc that it needs on x86-64."""
    for target, folder in ((c_library.LINUX, plugins / "x86_64"), (c_library.ARM64, plugins / "arm64")):
        folder.mkdir(parents=True)
        library = folder / "libpalpate.so"
        shutil.copyfile(c_library.built_library(release, target), library)
        library.chmod(0o755)
        target.system.stripped(library)
        brought = shared_objects.self_contained([library], folder, target.system, shared_objects.renamed_flat)
        if target is c_library.LINUX:
            licences.of_this_machine(notices, brought, target.build(release), ["palpate_c"])
    c_library.windows_dll(release, plugins / "x86_64/palpate.dll")
    licences.of_windows(notices, release.build.parent / "win64", "palpate_c")
    return ".".join(map(str, shared_objects.newest_symbol((plugins / "x86_64").glob("*.so"), "GLIBC")))


def make_unity(release: Release) -> None:
    with tempfile.TemporaryDirectory() as folder:
        package, notices = pathlib.Path(folder) / "package", pathlib.Path(folder) / "notices"
        notices.mkdir()
        shutil.copytree(SOURCE, package)
        glibc = bring_plugins(release, package / "Plugins", notices)
        shutil.copyfile(ROOT / "engine/bindings/c/samples/Palpate.cs", package / "Runtime/Palpate.cs")
        about = json.loads((package / "package.json").read_text())
        about["version"] = release.version
        (package / "package.json").write_text(json.dumps(about, indent=2) + "\n")
        (package / "README.md").write_text((package / "README.md").read_text().replace("GLIBC", glibc))
        shutil.copyfile(ROOT / "LICENSE", package / "LICENSE.md")
        changes = notes.brief((ROOT / "CHANGELOG.md").read_text(), release.version)
        (package / "CHANGELOG.md").write_text(f"# Changelog\n\n## [{release.version}]\n\n{changes}\n")
        texts = [f"# {file.stem}\n\n```\n{file.read_text(errors='replace').strip()}\n```\n" for file in sorted(notices.iterdir())]
        (package / "Third Party Notices.md").write_text("\n".join(texts))
        fill_scene(package)
        write_metas(package)
        archives.tar_gz(release.out / f"{NAME}-{release.version}.tgz", package, "package", release.epoch)
