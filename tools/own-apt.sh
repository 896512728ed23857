# Sourced. An apt of its own, for packages of another architecture or another Debian: with another idea of what is installed
# (nothing), and the servers that this machine asks.

own_apt() { # FOLDER SUITE ARCHITECTURE: sets APT_CONFIG and `mirror`; `apt-get update` is left to the caller, who may add sources
  local folder=$1 suite=$2 architecture=$3
  mkdir -p "$folder"/{state/lists/partial,cache/archives/partial,source}
  : >>"$folder/state/status"
  signed='[signed-by=/usr/share/keyrings/debian-archive-keyring.gpg]'
  mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Codename: bookworm' | head -1)
  [ -n "$mirror" ] || { echo "$0: this needs the package lists of Debian 12: apt-get update" >&2; exit 2; }
  printf 'deb %s %s %s main\n' "$signed" "$mirror" "$suite" >"$folder/sources.list"
  cat >"$folder/apt.conf" <<END
Dir::State "$folder/state";
Dir::State::status "$folder/state/status";
Dir::Cache "$folder/cache";
Dir::Etc::SourceList "$folder/sources.list";
Dir::Etc::SourceParts "/dev/null";
Dir::Etc::PreferencesParts "/dev/null";
APT::Architecture "$architecture";
APT::Architectures "$architecture";
APT::Sandbox::User "$(id -un)";
Debug::NoLocking "1";
END
  export APT_CONFIG=$folder/apt.conf
}
