# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# summary: build the manual as web pages: guides, READMEs, API reference

verb_usage() {
  cat <<'EOT'
usage: panvo docs [--out DIR]

Builds the manual as web pages: the guides in config/manual/guides, the packages' READMEs, and the API reference of the public headers. Open
DIR/index.html. A broken link or reference is an error. Nothing is compiled.

  --out DIR   folder for the pages: new, empty, or with an earlier manual, which is replaced (default: build/docs)

Needs doxygen, mkdocs and its theme "material"; 'panvo setup docs' installs them. The search field needs a web server:
python3 -m http.server --directory build/docs
EOT
}

verb_main() {
  require_checkout
  local out=$PANVO_HOME/build/docs tool scratch
  while (($#)); do
    case $1 in
      --out)
        require_value "$@"
        out=$(realpath -m -- "$2")
        shift
        ;;
      *) unknown_option "$1" ;;
    esac
    shift
  done
  for tool in doxygen mkdocs; do
    command -v "$tool" >/dev/null || fail "$tool not found; 'panvo setup docs' installs it"
  done
  require_replaceable "$out"

  note "checking the links of all Markdown files"
  python3 -B "$PANVO_HOME/tests/lint/links.py" "$PANVO_HOME" || fail "broken links, listed above"
  scratch=$(mktemp -d "${TMPDIR:-/tmp}/panvo-docs.XXXXXX")
  # shellcheck disable=SC2064  # the folder is local to this function
  trap "rm -rf '$scratch'" EXIT
  note "API reference"
  write_api "$scratch/doxygen"
  note "guides and READMEs"
  PANVO_API=$scratch/doxygen PYTHONDONTWRITEBYTECODE=1 mkdocs build --config-file "$PANVO_HOME/config/manual/mkdocs.yml" \
    --site-dir "$scratch/manual" >"$scratch/mkdocs.log" 2>&1 || {
    cat "$scratch/mkdocs.log" >&2
    fail "mkdocs found errors, listed above; if its theme is missing, 'panvo setup docs' installs it"
  }

  mkdir -p -- "$out"
  # The manual contains copies of files; colcon must not take them for packages.
  [[ $out != "$PANVO_HOME"/build/* ]] || touch "$PANVO_HOME/build/COLCON_IGNORE"
  touch -- "$out/.panvo_manual"
  find "$out" -mindepth 1 -not -name .panvo_manual -delete
  cp -r -- "$scratch/manual/." "$out"
  note "the manual is in $out/index.html"
}

# require_replaceable DIR: fails if DIR holds anything but an earlier manual.
require_replaceable() {
  [[ ! -e $1 || -e $1/.panvo_manual ]] && return
  [[ -d $1 && -z $(ls -A -- "$1") ]] || fail "'$1' exists and does not hold an earlier manual; choose another folder"
}

# write_api DIR: runs Doxygen over the include folders of all packages; the pages are in DIR/api.
write_api() {
  local -a headers=("$PANVO_HOME"/interfaces/include "$PANVO_HOME"/{components,drivers}/*/include)
  mkdir "$1"
  {
    cat "$PANVO_HOME/config/manual/Doxyfile"
    printf 'PROJECT_NUMBER = %s\nOUTPUT_DIRECTORY = "%s"\n' "$(panvo_version)" "$1"
    printf 'INPUT += "%s"\n' "$PANVO_HOME/config/manual/api.dox" "${headers[@]}"
    printf 'STRIP_FROM_PATH += "%s"\n' "${headers[@]}"
  } | doxygen - || fail "Doxygen found errors, listed above"
}
