/** Small controls that the panels share. */
import type { ComponentChildren, VNode } from 'preact';
import { wordsOf } from '../unions.ts';
import type { IconName } from './icons.tsx';
import { Icon } from './icons.tsx';

interface IconButtonProps {
  readonly icon: IconName;
  /** What the button does, beginning with a verb; it is also the tooltip. */
  readonly label: string;
  readonly onClick: (event: MouseEvent) => void;
  readonly id?: string;
  readonly pressed?: boolean;
  readonly disabled?: boolean;
}

/** A button that shows only an icon. */
export function IconButton({ icon, label, onClick, id, pressed, disabled }: IconButtonProps): VNode {
  return (
    <button
      type="button"
      class="square"
      id={id}
      title={label}
      aria-label={label}
      aria-pressed={pressed}
      disabled={disabled}
      onClick={onClick}
    >
      <Icon name={icon} />
    </button>
  );
}

export interface Choice<T extends string> {
  readonly value: T;
  readonly text: string;
  readonly disabled?: boolean;
}

/** A choice for each word of a union, with the text of that word. */
export function choicesOf<T extends string>(texts: Readonly<Record<T, string>>): readonly Choice<T>[] {
  return wordsOf(texts).map((value) => ({ value, text: texts[value] }));
}

interface SelectProps<T extends string> {
  readonly label: string;
  readonly value: T;
  readonly choices: readonly Choice<T>[];
  readonly disabled: boolean;
  readonly onChoice: (value: T) => void;
  readonly title?: string;
}

/** A list that opens, for one of several choices. */
export function Select<T extends string>({ label, value, choices, disabled, onChoice, title }: SelectProps<T>): VNode {
  return (
    <label class="field" title={title}>
      <span>{label}</span>
      <select
        value={value}
        disabled={disabled}
        onChange={(event) => {
          const choice = choices[event.currentTarget.selectedIndex];
          if (choice !== undefined) {
            onChoice(choice.value);
          }
        }}
      >
        {choices.map((choice) => (
          <option key={choice.value} value={choice.value}>
            {choice.text}
          </option>
        ))}
      </select>
    </label>
  );
}

interface CheckProps {
  readonly name: string;
  readonly text: string;
  readonly checked: boolean;
  readonly disabled?: boolean;
  readonly onChange: (checked: boolean) => void;
}

/** A checkbox. */
export function Check({ name, text, checked, disabled, onChange }: CheckProps): VNode {
  return (
    <label class="check">
      <input
        type="checkbox"
        name={name}
        checked={checked}
        disabled={disabled}
        onChange={(event) => {
          onChange(event.currentTarget.checked);
        }}
      />
      <span>{text}</span>
    </label>
  );
}

/** A section that opens below its headline. */
export function Fold({ title, children }: { readonly title: string; readonly children: ComponentChildren }): VNode {
  return (
    <details>
      <summary>
        <Icon name="turn" turns />
        {title}
      </summary>
      {children}
    </details>
  );
}
