// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0

// The answer to "why is there no line here?" of one service.

import { make } from './panels.js';

export function answerOf(service, answer) {
  const rows = [make('b', {}, service + ': '), answer.summary];
  const list = make('ul');
  for (const step of answer.changes ?? []) {
    list.append(make('li', {}, make('code', {}, step.parameter), ` is ${step.value}; ${step.would} would have let it pass`));
  }
  return make('div', { className: 'answer' }, ...rows, list);
}
