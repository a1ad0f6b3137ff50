// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0

// The answer to "why is there no line here?" of one service.

import { make } from './panels.js';

function changes(list) {
  const rows = make('ul');
  for (const each of list) {
    rows.append(make('li', {}, make('code', {}, each.service + ' ' + each.parameter), ` is ${each.value_text}; `,
      make('b', {}, each.would_text), each.first_of_several ? ' would have let it pass this step, but not the next' : ' would have let it pass'));
  }
  if (list.length === 0) rows.append(make('li', {}, 'no parameter alone would have let it pass'));
  return rows;
}

export function answerOf(service, answer) {
  const block = make('div', { className: 'answer' }, make('b', {}, service + ': '), answer.summary);
  if (answer.changes && answer.outcome !== 'segment') block.append(changes(answer.changes));
  for (const missing of answer.missing_corners ?? []) {
    block.append(make('p', {}, `no corner with line ${missing.line} (${missing.reason})`), changes(missing.changes));
  }
  return block;
}
