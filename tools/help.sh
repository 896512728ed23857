# Sourced first by the tools that are shell scripts: with --help one prints the comment that it opens with, and does nothing.
case "${1:-}" in
  -h | --help) awk 'NR > 1 && !/^#/ { exit } NR > 1 { sub(/^# ?/, ""); print }' "$0"; exit 0 ;;
esac
