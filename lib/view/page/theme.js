// Light or dark: as the system says, or as the page was told, which the browser keeps.
const KEY = 'phos-view theme';

export function followTheme(select) {
  const take = (theme) => { document.documentElement.dataset.theme = theme; };
  let kept = '';
  try {
    kept = localStorage.getItem(KEY) ?? '';
  } catch { /* a browser that keeps nothing */ }
  select.value = ['light', 'dark'].includes(kept) ? kept : '';
  take(select.value);
  select.onchange = () => {
    take(select.value);
    try {
      localStorage.setItem(KEY, select.value);
    } catch { /* the same */ }
  };
}
