/** The thumbnail of an answer of a search for landmarks: both meshes, turned as the views are. */
import type { VNode } from 'preact';
import { useEffect, useRef } from 'preact/hooks';
import type { AnswerPicture as Picture } from '../compute/match-messages.ts';
import { SIDES } from '../landmarks.ts';
import type { TurnedViews } from '../method/hands.ts';
import { paint, seenOf } from './answer-painting.ts';

interface AnswerPictureProps {
  readonly picture: Picture;
  readonly views: TurnedViews;
}

/** The size of the half of the picture that one mesh has, in pixels of the page. */
const [WIDTH, HEIGHT] = [116, 84];
/** The least time between two paintings while the views turn, in ms. */
const PAUSE = 80;

function draw(canvas: HTMLCanvasElement, picture: Picture, views: TurnedViews): void {
  const context = canvas.getContext('2d');
  const density = Math.min(2, window.devicePixelRatio);
  const [width, height] = [WIDTH * density, HEIGHT * density];
  [canvas.width, canvas.height] = [2 * width, height];
  for (const side of SIDES) {
    const axes = views.axes(side);
    if (context !== null && axes !== null) {
      paint(context, seenOf(picture, side, axes), { middle: [(side + 0.5) * width, 0.5 * height], width, height });
    }
  }
}

/**
 * The source and the target of one answer, the target in the colours of the matching places on the source. It is painted only while it is
 * in sight.
 */
export function AnswerPicture({ picture, views }: AnswerPictureProps): VNode {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    const element = canvas.current;
    if (element === null) {
      return undefined;
    }
    let timer: number | null = null;
    let leave: (() => void) | null = null;
    const later = (): void => {
      timer ??= window.setTimeout(() => {
        timer = null;
        draw(element, picture, views);
      }, PAUSE);
    };
    const observer = new IntersectionObserver((entries) => {
      leave?.();
      leave = null;
      if (entries.some(({ isIntersecting }) => isIntersecting)) {
        draw(element, picture, views);
        leave = views.whenTurned(later);
      }
    });
    observer.observe(element);
    return () => {
      observer.disconnect();
      leave?.();
      clearTimeout(timer ?? undefined);
    };
  }, [picture]);
  return <canvas ref={canvas} class="answer-picture" aria-hidden="true" />;
}
