#include "grader/page/style.h"

namespace carlo::grader {

std::string_view page_style() {
  return R"(<style>
:root { --good: var(--series-3); --bad: var(--series-2); }
.soft { color: var(--soft); }
h3 { margin: 0; font-size: 1.2rem; line-height: 1.3; }
h4 { margin: 0 0 0.6rem; font-size: 1rem; line-height: 1.4; }
code { padding: 0.1rem 0.4rem; border-radius: 5px; background: var(--grid);
       font: 0.9em ui-monospace, "DejaVu Sans Mono", monospace; }
pre { max-height: 20rem; margin: 0 0 1rem; padding: 0.8rem 1rem; overflow: auto; border-radius: 8px;
      background: var(--grid); font: 0.82rem/1.5 ui-monospace, "DejaVu Sans Mono", monospace;
      white-space: pre-wrap; unicode-bidi: isolate; }

.chip { display: inline-block; padding: 0.05rem 0.55rem; border: 1px solid currentColor;
        border-radius: 99px; color: var(--soft); font-size: 0.82rem; font-weight: 600;
        white-space: nowrap; }
.chip.passed { color: var(--good); }
.chip.failed { color: var(--bad); }
.aspects { display: inline-flex; flex-wrap: wrap; gap: 0.3rem; margin-left: 0.6rem;
           vertical-align: baseline; }
.overview { width: 100%; max-width: 56rem; font-size: 1rem; }
.overview td:first-child, .overview .number { width: 1%; white-space: nowrap; }

.exercise { margin-top: 2rem; padding: clamp(1rem, 3vw, 1.6rem); border: 1px solid var(--rule);
            border-left: 5px solid var(--bad); border-radius: 12px; scroll-margin-top: 1rem; }
.exercise.passed { margin-top: 0.8rem; padding-block: 0.6rem; border-left-color: var(--good); }
.exercise header, .exercise.passed > summary { display: flex; flex-wrap: wrap; gap: 0.4rem 0.8rem; align-items: center; }
.exercise.passed > summary { color: var(--ink); list-style: none; }
.exercise.passed h3 { font-size: 1rem; }
.exercise .points { margin-left: auto; color: var(--soft); font-variant-numeric: tabular-nums; }
.diagnosis { margin: 1.1rem 0 0; padding: 0.9rem 1.1rem; border-radius: 8px;
             background: rgb(184 122 0 / 0.14); }
.diagnosis p { margin: 0; font-size: 1.05rem; }
.diagnosis p + p { margin-top: 0.3rem; }
.exercise > .note, .help { margin: 1rem 0 0; }
.test { margin-top: 1.3rem; padding-top: 1.1rem; border-top: 1px solid var(--rule); }
.problem { color: var(--bad); }
.verdicts { display: grid; gap: 1.4rem 2rem; margin-bottom: 1rem;
            grid-template-columns: repeat(auto-fit, minmax(min(100%, 24rem), 1fr)); }
.verdict { display: flex; flex-direction: column; gap: 0.8rem; min-width: 0; }
.verdict figure { width: 100%; }
@media (min-width: 56rem) {
  .verdicts.one .verdict { display: grid; gap: 2rem; grid-template-columns: 1fr 1fr; }
  .verdict > div { flex: 1; }
}
.what { margin-bottom: 0.4rem; font-weight: 600; }
.verdict dd { overflow-wrap: anywhere; }
.verdict dt { color: var(--soft); font-weight: 400; }
.passed-tests { margin-top: 0.8rem; }
.passed-tests h4, .exercise.passed h4 { margin: 1rem 0 0; color: var(--ink); font-weight: 400; }
.exercise td { overflow-wrap: anywhere; min-width: 5rem; }
.exercise td:first-child { min-width: 0; }

figure { max-width: 32rem; }
figure table { width: 100%; }
figure th, .exercise figure td { min-width: 0; padding: 0.3rem 0 0.3rem 0.8rem; }
.exercise figure td { white-space: nowrap; }
figure th:first-child, .exercise figure td:first-child { padding-left: 0; text-align: left; }
@media (max-width: 34rem) {
  .exercise { padding: 0.9rem 0.8rem; }
  .verdict dl { grid-template-columns: minmax(0, 1fr); }
  .verdict dt { margin-top: 0.3rem; font-size: 0.85rem; }
  .aspects { margin-left: 0; }
  .overview .words { display: none; }
}
</style>
)";
}

}  // namespace carlo::grader
