/** The guide: what the program does, how to give it good landmarks, what its numbers mean, its method, its limits, how to cite it. */
import type { ComponentChildren, VNode } from 'preact';
import { useEffect, useRef } from 'preact/hooks';
import type { Report } from '../report.ts';
import type { Style } from '../store/state.ts';
import { LimbLandmarks } from './drawings/surfaces.tsx';
import { Equation } from './equation.tsx';
import './guide.css';
import { PAPERS } from './papers.ts';
import { QUANTITIES } from './quantities.ts';
import type { MethodStep } from './steps.ts';
import { METHOD } from './steps.ts';

const SECTIONS = [
  ['what', 'What Conemap does'],
  ['landmarks', 'Picking landmarks'],
  ['warnings', 'When it warns'],
  ['numbers', 'What the numbers mean'],
  ['method', 'The method in ten steps'],
  ['limits', 'Limits'],
  ['citing', 'How to cite'],
] as const;

type SectionId = (typeof SECTIONS)[number][0];

export interface GuideProps {
  /** The report of the map that the views show; `null` where they show none. */
  readonly report: Report | null;
  /** The section to begin with, as a link names it. Each request is a new object, so that the same section can be asked for again. */
  readonly wish: { readonly section: string };
  /** Shows something on the meshes and closes the guide. */
  readonly show: (look: Partial<Style>) => void;
}

/** Scrolls a section to the top, and gives it the keyboard focus. */
function goTo(root: HTMLElement | null, id: string): void {
  const heading = root?.querySelector<HTMLElement>(`#guide-${CSS.escape(id)} > h3`);
  heading?.scrollIntoView({ block: 'start' });
  heading?.focus({ preventScroll: true });
}

function Section({ id, children }: { readonly id: SectionId; readonly children: ComponentChildren }): VNode {
  const [, title] = SECTIONS.find(([candidate]) => candidate === id) ?? ['', ''];
  return (
    <section id={`guide-${id}`} aria-labelledby={`guide-title-${id}`}>
      <h3 id={`guide-title-${id}`} tabIndex={-1}>
        {title}
      </h3>
      {children}
    </section>
  );
}

function Contents({ go }: { readonly go: (id: SectionId) => void }): VNode {
  return (
    <nav aria-label="Sections of the guide">
      <ul>
        {SECTIONS.map(([id, title]) => (
          <li key={id}>
            <a
              href={`#guide=${id}`}
              onClick={(event) => {
                event.preventDefault();
                go(id);
              }}
            >
              {title}
            </a>
          </li>
        ))}
      </ul>
    </nav>
  );
}

function Landmarks(): VNode {
  return (
    <Section id="landmarks">
      <p>
        A landmark pair says: this point of the source belongs to that point of the target. The map takes every landmark exactly to
        its partner, and everything between goes where it is stretched least. So landmarks are worth most where that alone would not
        tell.
      </p>
      <ul>
        <li>
          <strong>Ends first.</strong> A limb without a landmark may end up anywhere: put one at the tip of each leg, ear, tail and
          nose. “Suggest places” in the step Landmarks finds them.
        </li>
        <li>
          <strong>Three around the end of a limb, not in a line.</strong> One point lets the limb turn about it, and so do three along
          it. Three in a ring, as around an ankle, say which way it faces.
        </li>
        <li>
          <strong>Then the body.</strong> Both sides where the limbs begin, the middle of the back, of the chest and the belly: what
          lies between two landmarks is shared out evenly.
        </li>
        <li>
          <strong>What can be found again.</strong> Corners of eyes and mouths, tips, joints. A point that you would place elsewhere
          tomorrow pulls the map to where it happens to be; leave it out.
        </li>
        <li>
          <strong>How many.</strong> Four are the least. Ten make a fair map of a body, 20 to 35 a good one of an animal. With at most 16
          the program adds points of its own, at places that it has found itself, and says how many.
        </li>
        <li>
          <strong>Spread, not heaped.</strong> Two landmarks close together on one mesh and far apart on the other force all the stretch
          that lies between them.
        </li>
        <li>
          <strong>Left is left.</strong> Mind the side: a left paw on one mesh and a right one on the other make the map wind. Where all
          pairs are the wrong way round, the page offers to mirror the target.
        </li>
        <li>
          <strong>Both sides at once.</strong> With “Left and right together” in the step Landmarks a click gives its mirror image, too,
          as a pair of its own. Of a body that is bent to one side no plane is found: place both sides yourself.
        </li>
      </ul>
      <LimbLandmarks />
      <p>
        With a map there, a click on one mesh proposes its image on the other: take it with Enter where it is right, and correct it with
        a click where it is not. A few corrections at the worst places are worth more than many new pairs.
      </p>
    </Section>
  );
}

const WARNINGS: readonly (readonly [string, string])[] = [
  ['Pairs look swapped, misplaced or mirrored', 'The distances over the surface, or the order around a landmark, do not agree between the meshes. Look at the named pairs; the button beside the sentence repairs them, and Undo takes it back. The map can be made without that.'],
  ['A limb without a landmark', 'The end that is named has none near it. Take the suggestion, or leave it where that limb has no partner.'],
  ['Another class of maps is nearly as good', 'The map may go another way round some limb. One more pair beside it decides; the other map is made by the choice “runner-up” under Details.'],
  ['A path is much longer than the shortest', 'The map may wind around a limb: see whether two pairs are swapped, or add a pair there.'],
  ['5 % of the surface is strongly distorted', 'Look at the worst places: mostly a limb has no landmark, or only one. Where the shapes truly differ, as with and without horns, it stays.'],
  ['Caps over holes', 'The surface there is made up and counts little. What it is mapped to means nothing.'],
  ['No cone metric, no overlay', 'The map stands and is certified; only the texture or the fine measures are missing. Very thin triangles are the common cause.'],
];

function Warnings(): VNode {
  return (
    <Section id="warnings">
      <p>A warning does not stop a run: it stands beside the map, or before it. A sentence in red says why there is no map.</p>
      <dl>
        {WARNINGS.map(([what, todo]) => (
          <div key={what}>
            <dt>{what}</dt>
            <dd>{todo}</dd>
          </div>
        ))}
      </dl>
    </Section>
  );
}

function Numbers({ report }: Pick<GuideProps, 'report'>): VNode {
  return (
    <Section id="numbers">
      <dl>
        {QUANTITIES.map(({ name, text, value }) => {
          const here = report === null ? null : value(report);
          return (
            <div key={name}>
              <dt>{name}</dt>
              <dd>
                {text} {here !== null && <span class="here">Of the map on the page: {here}.</span>}
              </dd>
            </div>
          );
        })}
      </dl>
    </Section>
  );
}

interface StepProps extends Pick<GuideProps, 'report' | 'show'> {
  readonly step: MethodStep;
}

function Step({ step, report, show }: StepProps): VNode {
  const { name, text, formula, Picture, fact, look } = step;
  const here = report === null ? null : fact(report);
  return (
    <li>
      <h4>{name}</h4>
      <div class="columns">
        <div>
          {text.map((paragraph) => (
            <p key={paragraph}>{paragraph}</p>
          ))}
          <Equation {...formula} />
          {here !== null && <p class="here">{here}</p>}
          {look !== null && report !== null && (
            <button
              type="button"
              onClick={() => {
                show(look);
              }}
            >
              Show it on the meshes
            </button>
          )}
        </div>
        <Picture />
      </div>
    </li>
  );
}

function Limits(): VNode {
  return (
    <Section id="limits">
      <p>
        <strong>What is refused.</strong> What is mapped is one closed surface without handles. Holes are capped, faults of the mesh are
        repaired, and both are told. Handles are cut only where you ask for it; one-sided surfaces and open sheets are refused in a
        sentence, and so are several large parts, of which the page offers to keep the largest. A surface that goes through itself is not noticed. A map needs at least four pairs, and two pairs
        cannot share a point.
      </p>
      <p>
        <strong>What is proved.</strong> That the map is piecewise linear, continuous, one-to-one and onto, and meets every landmark.
      </p>
      <p>
        <strong>What is not proved.</strong> That no map is better. The energy is near its least value among the maps of the chosen class,
        and the class is the best of those that were tried; neither is shown to be the least of all. Nor is a map of little distortion a
        correspondence that an anatomist would sign: it knows shapes and landmarks, and nothing else.
      </p>
      <p>
        <strong>Where to be careful.</strong> The exact map lives on the overlay of both meshes: take a texture from the GLB, not from the
        images of the vertices alone, where the target’s triangles are large. The method “thesis” is there for comparison, leaves
        some vertices without an image and has no certificate.
      </p>
    </Section>
  );
}

function Citing(): VNode {
  return (
    <Section id="citing">
      <p>
        Name Conemap with its version or the date, the number of landmarks, and what was chosen under Details; whoever has the map file
        has all of it. The method stands on these papers: cite the ones whose part matters to you.
      </p>
      <ol class="papers">
        {PAPERS.map(({ authors, year, title, where, use }) => (
          <li key={title}>
            {authors} ({year}): <cite>{title}</cite>. {where}. <span class="quiet">Here: {use}.</span>
          </li>
        ))}
      </ol>
    </Section>
  );
}

/** The whole guide. */
export default function Guide({ report, wish, show }: GuideProps): VNode {
  const root = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (wish.section !== '') {
      goTo(root.current, wish.section);
    }
  }, [wish]);
  return (
    <div ref={root} class="guide">
      <Contents
        go={(id) => {
          goTo(root.current, id);
        }}
      />
      <Section id="what">
        <p>
          Conemap maps one surface onto another. You give two meshes and pairs of corresponding points; it gives every other point its
          partner, so that nothing is torn, folded or left out and as little as possible is stretched. What lies on one mesh – a
          texture, a colour, a measurement, landmarks, the shape itself – can then be carried to the other.
        </p>
        <p>
          All of it is computed on your machine, in this page. No mesh leaves it. The same input gives the same map, here and on the
          command line.
        </p>
      </Section>
      <Landmarks />
      <Warnings />
      <Numbers report={report} />
      <Section id="method">
        <p>
          From two meshes and their landmarks to a map with a proof: steps 1 to 8. Steps 9 and 10 make the texture coordinates. The
          drawings are computed while you move their sliders.
        </p>
        <ol class="method">
          {METHOD.map((step) => (
            <Step key={step.name} step={step} report={report} show={show} />
          ))}
        </ol>
      </Section>
      <Limits />
      <Citing />
    </div>
  );
}
