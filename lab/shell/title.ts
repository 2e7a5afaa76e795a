/* What a model of one's own is called: by its own first comment. Pure. */
const longest = 48;

/** '': it has none that could be a title. */
export function ownTitle(text: string): string {
  const comment = /^\s*#+\s*(.+)/.exec(text)?.[1] ?? '', sentence = (/^.*?\.(?=\s|$)/.exec(comment)?.[0] ?? comment).trim().replace(/[.:]$/, '');
  const title = sentence.charAt(0).toUpperCase() + sentence.slice(1);
  return title.length <= longest && /\p{L}/u.test(title) ? title : '';
}
