#!/usr/bin/env bash
# additions_test.sh ROOT BUILD: additions to the renderer cannot silently miss a place. On a copy of
# the tree this adds kinds that nothing handles (a shape, a material, a light, a sampler), one after
# the other, and runs the compiler, for errors only: it must report every place that distinguishes
# kinds. Such places are every match() and std::visit(), every switch over kinds, and every place
# that takes OtherLights or Needs apart. Code that silently ignores unknown kinds (get_if,
# holds_alternative, ==, a light by its name) needs a reason in the list below. The page on
# additions: solutions/renderer/README.md.
set -euo pipefail
root=$1 build=$2
fail() { printf 'additions_test: %s\n' "$*" >&2 && exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
tree=$work/tree
mkdir "$tree"
(cd "$root" && find common solutions labs -name '*.h' -o -name '*.cpp') | tar -C "$root" -cf - -T - | tar -C "$tree" -xf -
cd "$tree"

# Passes over kinds ---------------------------------------------------------------------------------

# FILE|TEXT OF THE LINE|why no kind is forgotten there.
reasons='
common/course/json/json_fields.cpp|get_if<|a value of JSON, nothing of a scene
common/course/report/predictions.cpp|get_if<|a value of JSON, nothing of a scene
common/course/report/predictions.cpp|holds_alternative<|a value of JSON, nothing of a scene
common/scene/digits.cpp|get_if<Parallelogram>|only parallelograms have planes that floats misplace; what is near to them is thing_of()
common/scene/duplicate_faces.cpp|get_if<Mesh>|only meshes have triangles
common/scene/duplicate_lights.cpp|holds_alternative<Mesh>|a kind that this does not know is compared whole: MiddleOf must know it
common/scene/duplicate_lights.cpp|get_if<Parallelogram>|only parallelograms are halves of triangles
common/scene/duplicate_lights.cpp|get_if<Mesh>|only meshes have triangles
common/scene/duplicate_lights.cpp|holds_alternative<Parallelogram>|only these two kinds are compared as triangles
common/scene/sdf.cpp|get_if<Solid>|the other kind of step follows by std::get, which throws
solutions/renderer/lanes/lane_sdf.cpp|get_if<sdf::Solid>|the other kind of step follows by std::get, which throws
common/scene/load_scene.cpp|lights.environment = |<emitter type="constant">
common/scene/load_scene.cpp|lights.envmap = |<emitter type="envmap">
common/scene/load_scene.cpp|lights.points.push_back|<emitter type="point">
solutions/renderer/lights.cpp|lights.points[entry.index]|the entry is that of a point light
solutions/renderer/bench/floors.cpp|lights.environment = |makes a scene
solutions/renderer/bench/shapes.cpp|lights.environment = |makes a scene
solutions/renderer/bench/shapes.cpp|lights.points.push_back|makes a scene
solutions/renderer/bench/triangles.cpp|get_if<carlo::Mesh>|the memory of meshes is what is asked for
solutions/renderer/bench/peer_scene.cpp|get_if<carlo::Sphere>|all other shapes go to mesh(), which matches every kind
solutions/renderer/bench/peer_scene.cpp|get_if<carlo::Mesh>|only meshes have vertex normals
solutions/renderer/bench/scaling.cpp|holds_alternative<carlo::Parallelogram>|looks for a light to cut, an error if there is none
solutions/renderer/bench/scaling.cpp|get_if<carlo::Diffuse>|the light of one scene, of which this makes another
solutions/renderer/bench/scenes.cpp|m.way.sampler == SamplerKind::independent|the row that others are compared with
solutions/renderer/bench/scenes.cpp|m.way.sampler != SamplerKind::stratified|one line fewer in a chart
solutions/renderer/bench/methods.cpp|sampler != SamplerKind::independent|lab 8.4 draws its own numbers: one row
labs/08_path_tracer/given/world.cpp|get_if<carlo::Phong>|an error follows
labs/08_path_tracer/given/world.cpp|get_if<carlo::Mesh>|any other shape is one light
labs/08_path_tracer/given/world.h|return scene_.lights.environment|checked() lets no scene with other lights come
labs/08_path_tracer/phong_experiment.cpp|scene.lights.environment = |makes a scene
labs/08_path_tracer/specular_experiment.cpp|scene.lights.environment = |makes a scene
solutions/08_path_tracer/steps/g_specular.cpp|get_if<carlo::|the last kind is taken by std::get, which throws
solutions/08_path_tracer/steps/h_path_tracer.cpp|get_if<carlo::|the last kind is taken by Surface::phong(), which throws
labs/09_bias/practice_methods.cpp|get_if<carlo::|the last kind is taken by Surface::phong(), which throws
labs/09_bias/leak_experiment.cpp|scene.lights.environment = |makes a scene
labs/09_bias/noisy_image.cpp|get_if<carlo::Phong>|all other kinds count as white
labs/09_bias/photon_run.cpp|holds_alternative<carlo::Phong>|a picture of the floor alone
solutions/09_bias/steps/d_photons.cpp|get_if<carlo::|the last kind is taken by Surface::phong(), which throws
solutions/09_bias/steps/d_photons.cpp|holds_alternative<carlo::Phong>|what is stored; scatter() knows the others
solutions/09_bias/steps/e_density.cpp|get_if<carlo::|the last kind is taken by Surface::phong(), which throws
'
by_name='get_if<|holds_alternative<|[=!]= *(carlo::)?SamplerKind::|lights\.(points|environment|envmap)'
grep -rnE "$by_name" common solutions labs >"$work/by_name"
while IFS=: read -r file line text; do
  known=''
  while IFS='|' read -r where what _; do
    if [ "$where" = "$file" ] && [[ $text = *"$what"* ]]; then known=1 && printf '%s|%s\n' "$where" "$what" >>"$work/used"; fi
  done <<<"$reasons"
  [ "$known" ] || fail "$file:$line passes over kinds that it does not know; use carlo::match, or say why here: $text"
done <"$work/by_name"
while IFS='|' read -r where what _; do
  [ ! "$where" ] || grep -qxF "$where|$what" "$work/used" || fail "the list has a reason for '$what' in $where, where there is none"
done <<<"$reasons"

# Places --------------------------------------------------------------------------------------------

{
  grep -rnE '\b(match|std::visit)\(' common solutions labs | grep -v '^common/scene/match.h:' |
    grep -v '^common/course/verdict/' # kinds of figures do not concern the renderer
  grep -rnE 'auto& \[(.*\benvironment|parallelograms)\b' common solutions labs
  grep -rnE -A1 'switch \(' common solutions labs | sed -nE '/case [A-Za-z:]*Kind::/{s/^([^ ]*)-([0-9]+)-.*/\1 \2/p}' |
    while read -r file line; do printf '%s:%d:\n' "$file" "$((line - 1))"; done
} | sed -E 's/^([^:]*:[0-9]+):.*/\1/' | sort -u >"$work/places"
[ "$(wc -l <"$work/places")" -ge 30 ] || fail "found $(wc -l <"$work/places") places only: $(cat "$work/places")"

# file<TAB>command for everything that is compiled.
awk -F'": "' '
  /^ *"command"/ { sub(/",?$/, "", $2); command = $2; gsub(/\\"/, "\"", command) }
  /^ *"file"/ { sub(/",?$/, "", $2); print $2 "\t" command }' "$build/compile_commands.json" >"$work/commands"

# The line of $work/commands that compiles a file of the tree, by itself or with others.
unit_of() {
  local together
  together=$(grep -lF "\"$1\"" "$build"/together/*/*.cpp 2>/dev/null | tail -n 1) || true
  grep -m1 -F "${together:-$root/$1}"$'\t' "$work/commands" || fail "nothing compiles $1"
}

# compile UNIT: the compiler's output for a line of $work/commands, on the copy.
compile() {
  local command=${1#*$'\t'} all=''
  command=${command#*ccache } command=${command/ -o * -c / -c }
  command=${command//-I$root/-I$tree}
  command=${command/-c $root\/common/-c $tree/common} command=${command/-c $root\/solutions/-c $tree/solutions}
  command=${command/-c $root\/labs/-c $tree/labs}
  # GCC reports all errors by default.
  [[ $command != *clang++* ]] || all='-ferror-limit=0 -ftemplate-backtrace-limit=0'
  (cd "$build" && LC_ALL=C eval "$command -fsyntax-only -Werror=switch $all" 2>&1) || true
}

# change FILE SED-SCRIPT
change() {
  sed -i -E "$2" "$1"
  ! cmp -s "$1" "$root/$1" || fail "$1 is not what this test thinks: it could not add to it"
}

# try WHAT PATTERN: compiles the files that have places and match the pattern; the reported places
# go to $work/named. Afterwards restores the copy.
try() {
  local file unit
  cut -d: -f1 "$work/places" | sort -u | while read -r file; do
    # Places in a header are reported with the files that use it.
    if [[ $file = *.cpp ]] && grep -qE "$2" "$file"; then unit_of "$file"; fi
  done | sort -u >"$work/units"
  : >"$work/words"
  while read -r unit; do compile "$unit" >>"$work/words"; done <"$work/units"
  { grep -oE "$tree/[^: ]+:[0-9]+" "$work/words" || true; } | sed -E "s#^$tree/##; s#[^/]+/\.\./##" | sort -u | comm -12 - "$work/places" >"$work/now"
  [ -s "$work/now" ] || fail "added $1, and the compiler says nothing: $(tail -n 5 "$work/words")"
  printf '%s: %d places in %d files\n' "$1" "$(wc -l <"$work/now")" "$(cut -d: -f1 "$work/now" | sort -u | wc -l)"
  cat "$work/now" >>"$work/named"
  for file in "${changed[@]}"; do cp "$root/$file" "$file"; done
}

changed=(common/scene/scene.h common/scene/sdf.h common/scene/needs.h common/geometry/intersector.cpp)
change common/scene/scene.h 's/^struct Shape \{/struct NewShape {\n  Vec3 at;\n};\n&/; s/(std::variant<.*)> geometry/\1, NewShape> geometry/'
change common/scene/sdf.h 's/^struct Solid \{/struct NewForm {\n  double size;\n};\n&/; s/(std::variant<.*)> form/\1, NewForm> form/'
change common/scene/needs.h 's/^struct Needs \{/&\n  std::size_t new_shapes = 0;/'
change common/geometry/intersector.cpp 's/(enum class Kind .*), meshes \}/\1, new_shapes, meshes }/'
try 'a shape' 'geometry|form|Needs|std::variant'

changed=(common/scene/scene.h solutions/renderer/path_integrator.cpp labs/08_path_tracer/given/world.h)
change common/scene/scene.h 's/^struct Material \{/struct NewMaterial {\n  Rgb colour;\n};\n&/; s/(std::variant<.*)> model/\1, NewMaterial> model/'
change solutions/renderer/path_integrator.cpp 's/(std::variant<.*)> bsdf/\1, carlo::Sphere> bsdf/'
change labs/08_path_tracer/given/world.h 's/(using Material = std::variant<.*)>/\1, carlo::Sphere>/'
try 'a material' '\.model|bsdf|Material& material|std::variant'

changed=(common/scene/scene.h solutions/renderer/lights.h)
change common/scene/scene.h 's/^struct OtherLights \{/struct NewLight {\n  Vec3 at;\n};\n&\n  std::vector<NewLight> new_lights;/'
change solutions/renderer/lights.h 's/(enum class Kind .*) \}/\1, new_light }/'
try 'a light' 'lights;|OtherLights|Kind::shape'

changed=(common/scene/scene.h)
change common/scene/scene.h 's/(enum class SamplerKind .*) \}/\1, new_sampler }/'
try 'a sampler' 'SamplerKind'

sort -u "$work/named" | comm -13 - "$work/places" >"$work/silent"
[ ! -s "$work/silent" ] || fail "compiled in silence, whatever was added: $(tr '\n' ' ' <"$work/silent")"
printf 'every one of %d places was named\n' "$(wc -l <"$work/places")"
