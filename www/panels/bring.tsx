/**
 * The section that brings values, curves, a texture or poses of one mesh onto the other: files are chosen, brought by a worker, and saved.
 */
import type { VNode } from 'preact';
import { useEffect, useReducer, useRef } from 'preact/hooks';
import type { Choices, DeskState, Given, Role } from '../bring/desk.ts';
import { Desk, SIZES } from '../bring/desk.ts';
import { hindrance, KIND_NAMES, kindSentence } from '../bring/words.ts';
import { download, folderAmong } from '../dom.ts';
import '../method/watched.css';
import { shownResult } from '../store/staleness.ts';
import type { Actions, PartProps } from './actions.ts';
import type { Choice } from './controls.tsx';
import { choicesOf, Select } from './controls.tsx';

/** For each page its desk, which stays while other steps are open. */
const DESKS = new WeakMap<object, Desk>();

function deskOf({ bring }: Pick<Actions, 'bring'>): Desk {
  const known = DESKS.get(bring);
  if (known !== undefined) {
    return known;
  }
  const desk = new Desk({
    ...bring,
    save: ({ name, bytes }) => {
      download(name, 'application/octet-stream', bytes);
    },
  });
  DESKS.set(bring, desk);
  return desk;
}

const DIRECTIONS: Readonly<Record<Choices['from'], string>> = {
  target: 'Target onto source',
  source: 'Source onto target',
};

const METHODS: Readonly<Record<Choices['method'], string>> = {
  projection: 'Projection',
  mean: 'Mean',
  sample: 'Sample',
};

const ABOUT_METHODS: Readonly<Record<Choices['method'], string>> = {
  projection: 'The function on the other mesh that is nearest over the whole area; at sharp steps it goes a little beyond what is given.',
  mean: 'The mean over each vertex’s share of the area: a little blurred, and never beyond what is given.',
  sample: 'The value at each vertex’s image: quick, but blind to what lies between the vertices.',
};

const ROLES: readonly Choice<Role>[] = choicesOf<Role>({
  numbers: 'Numbers',
  labels: 'Labels',
  weights: 'Weights',
});

const VALUE_FORMATS: Readonly<Record<Choices['valueFormat'], string>> = {
  csv: 'CSV table',
  ply: 'PLY mesh',
};

const CURVE_FORMATS: Readonly<Record<Choices['curveFormat'], string>> = {
  json: 'JSON',
  csv: 'CSV',
  obj: 'OBJ lines',
};

const SIZE_CHOICES: readonly Choice<string>[] = SIZES.map((size) => ({ value: String(size), text: `${size} × ${size}` }));

/** The most columns whose roles can be chosen one by one. */
const MOST_OWN_COLUMNS = 100;

interface PartOf {
  readonly desk: Desk;
  readonly choices: Choices;
}

/** The choice of the role of each column. */
function OwnColumns({ desk, choices, columns }: PartOf & { readonly columns: readonly string[] }): VNode {
  return (
    <div class="bring-columns">
      {columns.map((name) => (
        <Select
          key={name}
          label={name}
          value={choices.roles.get(name) ?? 'numbers'}
          choices={ROLES}
          disabled={false}
          onChoice={(role) => {
            desk.choose({ roles: new Map([...choices.roles, [name, role]]) });
          }}
        />
      ))}
    </div>
  );
}

function ValueChoices({ desk, choices, columns }: PartOf & { readonly columns: readonly string[] }): VNode {
  const canOwn = columns.length > 1 && columns.length <= MOST_OWN_COLUMNS;
  return (
    <>
      <Select
        label="Columns hold"
        title="Labels are whole numbers that are not mixed; weights are never negative, and keep the sum of their row"
        value={choices.columns}
        choices={[...ROLES, { value: 'own', text: 'Each its own', disabled: !canOwn }]}
        disabled={false}
        onChoice={(held) => {
          desk.choose({ columns: held });
        }}
      />
      {choices.columns === 'own' && canOwn && <OwnColumns desk={desk} choices={choices} columns={columns} />}
      <Select
        label="Method"
        title="How the value at a vertex is computed from the values of the other mesh"
        value={choices.method}
        choices={choicesOf(METHODS)}
        disabled={false}
        onChoice={(method) => {
          desk.choose({ method });
        }}
      />
      <p class="quiet small">{ABOUT_METHODS[choices.method]}</p>
      <Select
        label="Save as"
        value={choices.valueFormat}
        choices={choicesOf(VALUE_FORMATS)}
        disabled={false}
        onChoice={(valueFormat) => {
          desk.choose({ valueFormat });
        }}
      />
    </>
  );
}

/** The choices for files of a kind. */
function KindChoices({ desk, choices, given }: PartOf & { readonly given: Given }): VNode | null {
  switch (given.kind) {
    case 'values':
      return <ValueChoices desk={desk} choices={choices} columns={given.columns} />;
    case 'curves':
      return (
        <Select
          label="Save as"
          value={choices.curveFormat}
          choices={choicesOf(CURVE_FORMATS)}
          disabled={false}
          onChoice={(curveFormat) => {
            desk.choose({ curveFormat });
          }}
        />
      );
    case 'texture':
      return (
        <Select
          label="Size"
          value={String(choices.size)}
          choices={SIZE_CHOICES}
          disabled={false}
          onChoice={(size) => {
            desk.choose({ size: Number(size) });
          }}
        />
      );
    case 'frames':
      return null;
  }
}

/** The place where files are chosen or dropped. */
function Chooser({ desk, state }: { readonly desk: Desk; readonly state: DeskState }): VNode {
  const input = useRef<HTMLInputElement>(null);
  const take = (files: FileList | null | undefined): void => {
    if (files !== null && files !== undefined && files.length > 0) {
      desk.take([...files]);
    }
  };
  // The page ignores events that are prevented here; otherwise it would take the files for meshes.
  return (
    <div
      class="bring-drop"
      onDragOver={(event) => {
        event.preventDefault();
      }}
      onDrop={(event) => {
        event.preventDefault();
        const folder = folderAmong(event.dataTransfer?.items);
        if (folder === null) {
          take(event.dataTransfer?.files);
        } else {
          desk.refuseFolder(folder);
        }
      }}
    >
      <button
        type="button"
        onClick={() => {
          input.current?.click();
        }}
      >
        {state.given === null ? 'Choose files…' : 'Other files…'}
      </button>
      <span class="quiet small">or drop them here</span>
      <input
        ref={input}
        type="file"
        id="bring-files"
        multiple
        hidden
        tabIndex={-1}
        aria-hidden="true"
        onChange={(event) => {
          take(event.currentTarget.files);
          event.currentTarget.value = '';
        }}
      />
    </div>
  );
}

/** The files with their choices, and the button that brings them across. */
function Files({ desk, state, given }: { readonly desk: Desk; readonly state: DeskState; readonly given: Given }): VNode {
  const { choices, work } = state;
  const names = given.files.map(({ name }) => name);
  return (
    <>
      <p class="small bring-kind">{kindSentence(names, given.kind, given.columns, choices.from)}</p>
      {given.kinds.length > 1 && (
        <Select
          label="Taken as"
          value={given.kind}
          choices={given.kinds.map((kind) => ({ value: kind, text: KIND_NAMES[kind] }))}
          disabled={false}
          onChoice={(kind) => {
            desk.takeFor(kind);
          }}
        />
      )}
      <KindChoices desk={desk} choices={choices} given={given} />
      <button
        type="button"
        id="bring-across"
        disabled={work !== null}
        onClick={() => {
          desk.bring();
        }}
      >
        Bring onto the {choices.from === 'target' ? 'source' : 'target'}
      </button>
    </>
  );
}

/** What is being done, the last result, and why there is none. */
function Outcome({ desk, state: { work, error, made } }: { readonly desk: Desk; readonly state: DeskState }): VNode {
  return (
    <>
      {work !== null && (
        <div class="watched">
          <p role="status">{work.kind === 'looking' ? 'Looking at the files…' : 'Bringing it across…'}</p>
          <div class="watched-row">
            <progress value={work.share} aria-label="Progress" />
            <button
              type="button"
              onClick={() => {
                desk.cancel();
              }}
            >
              Cancel
            </button>
          </div>
        </div>
      )}
      {error !== null && (
        <p role="alert" class="bring-error">
          {error}
        </p>
      )}
      {made !== null && work === null && (
        <div class="bring-made">
          <p role="status" class="small">
            {made.sentence}
          </p>
          <button
            type="button"
            onClick={() => {
              desk.saveAgain();
            }}
          >
            Save again
          </button>
        </div>
      )}
    </>
  );
}

/** The content of the section. */
export default function BringPanel({ state, actions }: PartProps): VNode {
  const desk = deskOf(actions);
  const [, redraw] = useReducer((count: number) => count + 1, 0);
  useEffect(
    () =>
      desk.subscribe(() => {
        redraw(undefined);
      }),
    [desk],
  );
  const shown = shownResult(state);
  useEffect(() => {
    desk.follow();
  }, [shown]);
  const reason = hindrance(state.result, shown);
  if (reason !== null) {
    return <p class="quiet">{reason}</p>;
  }
  const { given, choices, work } = desk.state;
  return (
    <>
      <p class="quiet small">Values, skin weights, labels, curves, a texture or poses of one mesh, onto the other.</p>
      <Select
        label="From"
        value={choices.from}
        choices={choicesOf(DIRECTIONS)}
        disabled={false}
        onChoice={(from) => {
          desk.choose({ from });
        }}
      />
      <Chooser desk={desk} state={desk.state} />
      {given !== null && <Files desk={desk} state={desk.state} given={given} />}
      <Outcome desk={desk} state={desk.state} />
      <ul class="export-list">
        <li>
          <div>
            <p>Each mesh in the other’s shape</p>
            <p class="quiet small">With their distances and how well the normals agree</p>
          </div>
          <button
            type="button"
            disabled={work !== null}
            onClick={() => {
              desk.bringShapes();
            }}
          >
            Shapes
          </button>
        </li>
      </ul>
    </>
  );
}
