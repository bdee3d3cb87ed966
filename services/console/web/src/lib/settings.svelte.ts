// What the user chose for this browser: language, theme, form of time. Kept in the browser's storage where it has one.
import { words, type Language } from './i18n/words.svelte';
import type { TimeForm } from './format';
import type { Theme } from './view/palette';

const KEY = 'lukou.settings';

interface Kept {
  language?: Language;
  theme?: Theme;
  timeForm?: TimeForm;
}

function kept(): Kept {
  try {
    return JSON.parse(localStorage.getItem(KEY) ?? '{}') as Kept;
  } catch {
    return {};
  }
}

class Settings {
  theme = $state<Theme>('light');
  timeForm = $state<TimeForm>('seconds');

  constructor() {
    const { language, theme, timeForm } = kept();
    const dark = matchMedia('(prefers-color-scheme: dark)').matches;
    this.theme = theme === 'light' || theme === 'dark' ? theme : dark ? 'dark' : 'light';
    this.timeForm = timeForm === 'clock' ? 'clock' : 'seconds';
    words.language = language ?? (navigator.language.startsWith('zh') ? 'zh' : 'en');
    this.show();
  }

  toggleTheme(): void {
    this.theme = this.theme === 'light' ? 'dark' : 'light';
    this.keep();
  }

  toggleLanguage(): void {
    words.language = words.language === 'en' ? 'zh' : 'en';
    this.keep();
  }

  toggleTimeForm(): void {
    this.timeForm = this.timeForm === 'seconds' ? 'clock' : 'seconds';
    this.keep();
  }

  /** As a link says: for this page, not for the next. */
  take(language: Language | undefined, theme: Theme | undefined): void {
    words.language = language ?? words.language;
    this.theme = theme ?? this.theme;
    this.show();
  }

  private keep(): void {
    this.show();
    const chosen: Kept = { language: words.language, theme: this.theme, timeForm: this.timeForm };
    try {
      localStorage.setItem(KEY, JSON.stringify(chosen));
    } catch {
      // A browser without storage forgets the choice with the page.
    }
  }

  private show(): void {
    document.documentElement.dataset.theme = this.theme;
    document.documentElement.lang = words.language === 'zh' ? 'zh-CN' : 'en';
  }
}

export const settings = new Settings();
