// The tokens of a C++ text: the kinds of its syntax tree's nodes in their order. Names, numbers, comments, layout,
// brackets, const, and whether a += b or a = a + b was written leave no trace.

const words = new Map([["number_literal", "number"], ["char_literal", "number"], ["true", "number"],
  ["false", "number"], ["string_literal", "string"], ["raw_string_literal", "string"]]);
for (const kind of ["identifier", "field_identifier", "type_identifier", "namespace_identifier",
  "qualified_identifier", "statement_identifier", "primitive_type", "sized_type_specifier",
  "placeholder_type_specifier", "auto"]) words.set(kind, "name");
const unseen = new Set(["comment", "preproc_include", "type_qualifier", "storage_class_specifier"]);
const transparent = new Set(["translation_unit", "compound_statement", "parenthesized_expression",
  "declaration_list"]);
const operator = /^[-+*/%<>=!&|^~?]+$/;

/// Returns what stands for an assignment: of a += b, what a = a + b has.
function assignment(node, at) {
  const [left, sign, right] = ["left", "operator", "right"].map((field) => node.childForFieldName(field));
  if (!left || !sign || !right) return null;
  const place = at ?? sign.startPosition;
  const again = sign.type === "=" ? [] : [{ token: "binary_expression", at: place }, { node: left, at: place },
    { token: sign.type.slice(0, -1), at: place }];
  return [{ node: left, at }, { token: "=", at: place }, ...again, { node: right, at }];
}

/// Returns the tokens with their places, {row, column}, and how many characters make no sense. Not recursive: a
/// submission may be nested deeply.
export function tokensOf(root, most) {
  const tokens = [], places = [], stack = [{ node: root }];
  let senseless = 0;
  const emit = (token, at) => { tokens.push(token); places.push(at); };
  while (stack.length > 0 && tokens.length <= most) {
    const { node, token, at } = stack.pop();
    if (token) { emit(token, at); continue; }
    const kind = node.type, place = at ?? node.startPosition;
    if (unseen.has(kind)) continue;
    if (node.isError) senseless += node.endIndex - node.startIndex;
    if (words.has(kind)) emit(words.get(kind), place);
    else if (!node.isNamed && operator.test(kind)) emit(kind, place);
    if (words.has(kind) || !node.isNamed || node.isError) continue;
    if (!transparent.has(kind)) emit(kind, place);
    const parts = (kind === "assignment_expression" && assignment(node, at)) ||
      (kind === "update_expression" ? node.namedChildren : node.children).map((child) => ({ node: child, at }));
    stack.push(...parts.reverse());
  }
  return { tokens, places, senseless };
}
